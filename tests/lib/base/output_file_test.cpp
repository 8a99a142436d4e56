// SPDX-License-Identifier: Apache-2.0
#include "base/output_file.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include <doctest/doctest.h>

#include "base/device_output.h"
#include "base/named_output.h"
#include "scratch_folder.h"

using namespace srisp;
namespace fs = std::filesystem;

namespace {

std::string text_of(const std::string& path)
{
    std::ifstream file(path);
    return { std::istreambuf_iterator<char>(file), {} };
}

std::size_t count(const std::string& folder)
{
    return std::size_t(std::distance(fs::directory_iterator(folder), {}));
}

/// Writes by name, as a library would.
Status write_by_name(const std::string& path, const std::string& text)
{
    NamedOutput file(path);
    if (!file.created())
        return file.created();
    std::ofstream(file.name()) << text;
    return file.finish();
}

using Writer = Status (*)(const std::string& path, const std::string& text);
const Writer kWriters[] = { write_output_file, write_by_name };

} // namespace

TEST_CASE("an output appears when it is complete, in place of an old one, with the rights that a user's file gets")
{
    const ScratchFolder scratch;
    const std::string path = scratch.path("a.txt");
    const mode_t mask = umask(022);
    for (const Writer write : kWriters) {
        for (const char* text : { "new", "newer" }) {
            CHECK(write(path, text));
            CHECK(text_of(path) == text);
        }
        struct stat info;
        REQUIRE(stat(path.c_str(), &info) == 0);
        CHECK((info.st_mode & 0777) == 0644);
        fs::remove(path);
    }
    umask(mask);
    scratch.file("a.txt", "old");
    {
        OutputFile unfinished(path);
        unfinished.write("new");
        NamedOutput also(path);
    }
    CHECK(text_of(path) == "old");
    CHECK(count(scratch.path()) == 1);
}

TEST_CASE("the first bytes of an output can be written again")
{
    const ScratchFolder scratch;
    OutputFile file(scratch.path("a"));
    file.write("....world");
    file.write_start("hell", 4);
    file.write("!");
    CHECK(file.finish());
    CHECK(text_of(scratch.path("a")) == "hellworld!");
}

TEST_CASE("links that were put where a temporary file might lie, or the output, are not followed")
{
    const ScratchFolder scratch;
    const std::string precious = scratch.file("precious", "kept"), path = scratch.path("a.txt");
    for (const Writer write : kWriters) {
        for (const std::string& name : { path + ".tmp-" + std::to_string(getpid()),
                                         scratch.path("a.tmp-" + std::to_string(getpid()) + ".txt"), path })
            if (!fs::exists(name))
                fs::create_symlink(precious, name);
        CHECK(write(path, "new"));
        CHECK(text_of(precious) == "kept");
        CHECK_FALSE(fs::is_symlink(path));
        CHECK(text_of(path) == "new");
        fs::remove(path);
        fs::create_symlink(scratch.path("nowhere"), path);
        CHECK(write(path, "new"));
        CHECK(text_of(path) == "new");
        CHECK_FALSE(fs::exists(scratch.path("nowhere")));
        fs::remove(path);
    }
}

TEST_CASE("pipes, devices and descriptors are written to, not replaced")
{
    const ScratchFolder scratch;
    const std::string pipe = scratch.path("pipe.txt"), link = scratch.path("null.txt");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    fs::create_symlink("/dev/null", link);
    for (const Writer write : kWriters) {
        std::string got;
        std::thread reader([&] { got = text_of(pipe); });
        CHECK(write(pipe, "through"));
        reader.join();
        CHECK(got == "through");
        CHECK(fs::is_fifo(pipe));
        CHECK(write(link, "x"));
        CHECK(fs::is_symlink(link));
        CHECK(fs::is_character_file("/dev/null"));

        const std::string log = scratch.file("log", "start\n");
        const int descriptor = open(log.c_str(), O_WRONLY | O_APPEND);
        const std::string numbered = "/dev/fd/" + std::to_string(descriptor), named = scratch.path("named");
        fs::create_symlink(numbered, named);
        CHECK(write(numbered, "one\n"));
        CHECK(write(named, "two\n"));
        CHECK(text_of(log) == "start\none\ntwo\n");
        close(descriptor);
        fs::remove(named);
        CHECK(count(scratch.path()) == 3);
    }
    fs::create_symlink("/dev/full", scratch.path("full"));
    const Status full = write_output_file(scratch.path("full"), "x");
    REQUIRE_FALSE(full);
    CHECK(full.error().message == "'" + scratch.path("full") + "' cannot be written: No space left on device");
    CHECK_FALSE(is_device_output(scratch.path()));
    CHECK_FALSE(is_device_output(scratch.path("none")));
    CHECK_FALSE(is_device_output("/proc/self/fd/"));
}

TEST_CASE("a program that is killed while it writes leaves no output, and what it leaves the next one removes")
{
    const ScratchFolder scratch;
    const std::string path = scratch.path("a.txt");
    for (const bool by_name : { false, true }) {
        const pid_t child = fork();
        if (child == 0) {
            OutputFile file(path);
            file.write("x");
            if (by_name)
                new NamedOutput(path);
            raise(SIGKILL);
        }
        waitpid(child, nullptr, 0);
        CHECK_FALSE(fs::exists(path));
    }
    for (const char* users : { "a.txt.tmp-12", ".a.partial-0123456789abcdef.txt", ".a.partial-mine.txt" })
        scratch.file(users);
    CHECK(write_by_name(path, "new"));
    CHECK(count(scratch.path()) == 4);
}

TEST_CASE("an output that grows beyond the limit for files fails with that reason")
{
    const ScratchFolder scratch;
    const std::string path = scratch.file("a", "old");
    signal(SIGXFSZ, SIG_IGN);
    rlimit limit;
    REQUIRE(getrlimit(RLIMIT_FSIZE, &limit) == 0);
    const rlimit small{ 4096, limit.rlim_max };
    setrlimit(RLIMIT_FSIZE, &small);
    const Status written = write_output_file(path, std::string(100000, 'x'));
    setrlimit(RLIMIT_FSIZE, &limit);
    REQUIRE_FALSE(written);
    CHECK(written.error().message == "'" + path + "' cannot be written: File too large");
    CHECK(text_of(path) == "old");
    CHECK(count(scratch.path()) == 1);
}

TEST_CASE("an output in no folder, and one that is a folder, are refused")
{
    const ScratchFolder scratch;
    const Status nowhere = write_output_file(scratch.path("no/a"), "x");
    REQUIRE_FALSE(nowhere);
    CHECK(nowhere.error().message == "'" + scratch.path("no/a") + "' cannot be created: No such file or directory");
    fs::create_directory(scratch.path("folder"));
    const Status folder = write_output_file(scratch.path("folder"), "x");
    REQUIRE_FALSE(folder);
    CHECK(folder.error().message ==
          "'" + scratch.path("folder") + "' cannot be renamed from its temporary name: Is a directory");
    CHECK(count(scratch.path()) == 1);
}
