// SPDX-License-Identifier: Apache-2.0
#include "raw_file/decoder_process.h"

#include <csignal>
#include <vector>

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <srisp/noise.h>
#include <srisp/reference.h>

#include "container/image_file.h"
#include "lib/reference/synthetic_dng.h"
#include "scratch_folder.h"

using namespace srisp;

namespace {

std::string big(std::uint32_t value, int bytes)
{
    std::string text;
    for (int i = bytes; i-- > 0;)
        text += char(value >> 8 * i & 255);
    return text;
}

/// Leaf's tags nested so deeply that LibRaw 0.20 runs out of stack.
std::string deep_file()
{
    std::string bytes = std::string("MM\0*", 4) + big(8, 4) + big(1, 2) + big(34310, 2) + big(7, 2) + big(100, 4) +
                        big(26, 4) + big(0, 4);
    for (int i = 0; i < 200'000; ++i)
        bytes += "PKTS" + big(1, 4) + std::string(40, 'x') + big(0, 4);
    return bytes;
}

/// Kodak's text about the camera, which LibRaw 0.20 copies to 64 bytes whatever its length.
std::string wordy_file()
{
    const std::string text = "Camera body:" + std::string(900, 'A') + "\n";
    return std::string("MM\0*", 4) + big(8, 4) + big(1, 2) + big(33424, 2) + big(4, 2) + big(1, 4) + big(26, 4) +
           big(0, 4) + big(1, 2) + big(0x03f1, 2) + big(2, 2) + big(std::uint32_t(text.size()), 4) + big(44, 4) +
           big(0, 4) + text;
}

std::string plain_dng()
{
    return SyntheticDng().fill([](int x, int y, int) { return 1000 + 500 * x + 300 * y; }).bytes();
}

/// How serve_decoder ends, as waitpid says it, with its answer.
struct Served {
    int status = 0;
    std::string answer;
};
template<class Decode> Served serve(std::vector<std::string> words, const Decode& decode)
{
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    const pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        std::vector<char*> arguments;
        for (std::string& word : words)
            arguments.push_back(word.data());
        _exit(serve_decoder(int(arguments.size()), arguments.data(), decode));
    }
    close(ends[1]);
    Served served;
    char block[4096];
    for (ssize_t count; (count = read(ends[0], block, sizeof block)) > 0;)
        served.answer.append(block, std::size_t(count));
    close(ends[0]);
    waitpid(child, &served.status, 0);
    return served;
}

} // namespace

TEST_CASE("A reference that was decoded by a program of its own is the one that is decoded here")
{
    const ScratchFolder folder;
    const std::string path = folder.file("plain.dng", plain_dng());
    const auto apart = load_reference(path), here = load_reference(path, false);
    REQUIRE(apart);
    REQUIRE(here);
    CHECK((*apart)->thumbnail.rgb == (*here)->thumbnail.rgb);
    CHECK((*apart)->hash == (*here)->hash);
    CHECK((*apart)->notes == (*here)->notes);
    CHECK((*apart)->path == path);
    CHECK((*apart)->facts.cfa_pattern == "RGGB");
    CHECK((*apart)->facts.white_level == (*here)->facts.white_level);
}

TEST_CASE("A file that makes LibRaw crash costs a message, as reference, as photo, and where a reference was")
{
    const ScratchFolder folder;
    std::string path;
    SUBCASE("by nesting without end")
    {
        path = folder.file("deep.nef", deep_file());
    }
    SUBCASE("by a long text")
    {
        path = folder.file("wordy.nef", wordy_file());
    }
    const auto reference = load_reference(path);
    REQUIRE(!reference);
    CHECK(reference.error().message.rfind("reference '" + path + "': ", 0) == 0);
    const auto photo = ImageFile::open(path, OIIO::ImageSpec(), "photo 'x'");
    REQUIRE(!photo);
    CHECK(photo.error().message.rfind("photo 'x': ", 0) == 0);
    Reference before; // another file of this name
    before.path = path;
    before.facts.cfa_pattern = "RGGB";
    const auto noise = reference_noise(before);
    REQUIRE(!noise);
    CHECK(noise.error().message.rfind("reference '" + path + "': no NoiseProfile, and noise cannot be estimated", 0) ==
          0);
    CHECK(noise.error().message.find("makes its decoder ") != std::string::npos);
}

TEST_CASE("What the decoding says of a file comes back word by word")
{
    const ScratchFolder folder;
    folder.file("none.dng", "II*");
    folder.file("cut.dng", plain_dng().substr(0, 600));
    for (const std::string name : { "none.dng", "cut.dng" }) {
        const auto apart = load_reference(folder.path(name)), here = load_reference(folder.path(name), false);
        REQUIRE(!apart);
        REQUIRE(!here);
        CHECK(apart.error().message == here.error().message);
    }
}

TEST_CASE("Decoding works in a host that ignores SIGCHLD, blocks signals, or closed its standard streams")
{
    const ScratchFolder folder;
    const std::string path = folder.file("plain.dng", plain_dng());
    const auto load_in_child = [&](const auto& prepare) {
        const pid_t child = fork();
        if (child == 0) {
            prepare();
            _exit(run_decoder(DecoderTask::reference, path) ? 0 : 1);
        }
        int status = 0;
        waitpid(child, &status, 0);
        return status;
    };
    CHECK(load_in_child([] { signal(SIGCHLD, SIG_IGN); }) == 0);
    CHECK(load_in_child([] {
              sigset_t all;
              sigfillset(&all);
              sigprocmask(SIG_BLOCK, &all, nullptr);
          }) == 0);
    CHECK(load_in_child([] {
              for (int file = 0; file < 3; ++file)
                  close(file);
          }) == 0);
}

TEST_CASE("The program stops a decoding without end, and one that takes all memory")
{
    const std::vector<std::string> words = { "srispdecode", SRISP_TEST_VERSION, "trial", "/dev/null" };
    const Served endless = serve(words, [](DecoderTask, const std::string&) -> Expected<std::string> {
        for (volatile unsigned i = 0;; i = i + 1)
            ;
    });
    CHECK(WIFSIGNALED(endless.status));
    CHECK((WTERMSIG(endless.status) == SIGXCPU || WTERMSIG(endless.status) == SIGKILL));
    CHECK(endless.answer.empty());
#ifndef SRISP_SANITIZED
    const Served greedy = serve(words, [](DecoderTask, const std::string&) -> Expected<std::string> {
        const std::vector<char> all(std::size_t(6) << 30, 1);
        return std::string(all.begin(), all.begin() + 1);
    });
    CHECK(WIFEXITED(greedy.status));
    CHECK(greedy.answer.find("takes more memory to decode than such a file can need") != std::string::npos);
#endif
}

TEST_CASE("The program answers none but its own version, and no wrong command line")
{
    const auto decode = [](DecoderTask, const std::string&) { return Expected<std::string>("decoded"); };
    CHECK(serve({ "srispdecode", SRISP_TEST_VERSION, "trial", "x" }, decode).answer.find("decoded") !=
          std::string::npos);
    CHECK(serve({ "srispdecode", "0.0.9", "trial", "x" }, decode).answer.find("not 0.0.9") != std::string::npos);
    const Served misused = serve({ "srispdecode", "x" }, decode);
    CHECK(WEXITSTATUS(misused.status) == 2);
    CHECK(misused.answer.empty());
}
