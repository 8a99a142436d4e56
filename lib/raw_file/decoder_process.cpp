// SPDX-License-Identifier: Apache-2.0
#include "raw_file/decoder_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/installed_files.h"
#include "base/write_all.h"

extern char** environ;

namespace srisp {

namespace {

const char kProgram[] = "srispdecode";
const char* const kTaskNames[] = { "reference", "noise", "preview", "trial" }; ///< by DecoderTask

// A reference's answer has less than 1 MiB, a camera's JPEG up to some tens.
constexpr std::size_t kMostAnswer = std::size_t(64) << 20;
// Processor time. The slowest formats take some 10 ns a byte.
constexpr std::uint64_t kSeconds = 5, kBytesPerSecond = 2'000'000;
// 1 GiB of samples, the file itself, and as much again.
constexpr rlim_t kMostMemory = rlim_t(4) << 30;

constexpr char kResult = 'R', kError = 'E';
constexpr std::size_t kAnswerHead = 9; // kind, then the size of what follows: 64 bits, native order

std::string framed(const Expected<std::string>& answer)
{
    const std::string& content = answer ? *answer : answer.error().message;
    const std::uint64_t size = content.size();
    std::string bytes(kAnswerHead, answer ? kResult : kError);
    std::memcpy(&bytes[1], &size, sizeof size);
    return bytes + content;
}

/// Whether the bytes are a whole answer.
bool is_whole(const std::string& bytes)
{
    std::uint64_t size = 0;
    if (bytes.size() < kAnswerHead || (bytes[0] != kResult && bytes[0] != kError))
        return false;
    std::memcpy(&size, &bytes[1], sizeof size);
    return bytes.size() - kAnswerHead == size;
}

/// What a program needs to be started; freed with the object.
class SpawnPlan {
public:
    explicit SpawnPlan(int output)
    {
        constexpr int kFirstOther = 3;
        ::posix_spawn_file_actions_init(&m_files);
        ::posix_spawnattr_init(&m_attributes);
        ::posix_spawn_file_actions_addopen(&m_files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        ::posix_spawn_file_actions_adddup2(&m_files, output, STDOUT_FILENO);
        ::posix_spawn_file_actions_addopen(&m_files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        ::posix_spawn_file_actions_addclosefrom_np(&m_files, kFirstOther); // the host's open files
        sigset_t none, all;
        ::sigemptyset(&none);
        ::sigfillset(&all);
        ::posix_spawnattr_setsigmask(&m_attributes, &none);
        ::posix_spawnattr_setsigdefault(&m_attributes, &all);
        // A group of its own: Ctrl-C is for the caller to handle, with whom this program ends.
        ::posix_spawnattr_setpgroup(&m_attributes, 0);
        ::posix_spawnattr_setflags(&m_attributes,
                                   POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    ~SpawnPlan()
    {
        ::posix_spawn_file_actions_destroy(&m_files);
        ::posix_spawnattr_destroy(&m_attributes);
    }
    SpawnPlan(const SpawnPlan&) = delete;
    SpawnPlan& operator=(const SpawnPlan&) = delete;

    /// 0, or an errno.
    int start(pid_t& child, const std::vector<const char*>& words) const
    {
        return ::posix_spawn(&child, words[0], &m_files, &m_attributes, const_cast<char* const*>(words.data()),
                             environ);
    }

private:
    posix_spawn_file_actions_t m_files;
    posix_spawnattr_t m_attributes;
};

/// All that comes, or the beginning where it is too much.
std::string read_answer(int pipe)
{
    std::string bytes;
    std::array<char, 65536> block;
    while (bytes.size() <= kMostAnswer) {
        const ssize_t count = ::read(pipe, block.data(), block.size());
        if (count == 0 || (count < 0 && errno != EINTR))
            break;
        bytes.append(block.data(), std::size_t(std::max<ssize_t>(count, 0)));
    }
    return bytes;
}

/// Why a program that gave no whole answer ended. `status`: of waitpid; none where the host took that.
Error death(bool known, int status)
{
    const std::string harm = "; it is damaged, or made to do harm";
    if (known && WIFSIGNALED(status)) {
        if (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)
            return Error{ "takes more time or memory to decode than such a file can need, so that was stopped" + harm };
        return Error{ std::string("makes its decoder crash (") + ::strsignal(WTERMSIG(status)) + ")" + harm };
    }
    return Error{ "makes its decoder end without an answer" + harm };
}

void limit(int resource, rlim_t value)
{
    const rlimit both{ value, value };
    ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// A file for whose decoding no time is allowed has a size that cannot be read, too.
void limit_this_process(const std::string& path)
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL); // nobody waits for the answer any more
    ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(path, unknown);
    limit(RLIMIT_CPU, kSeconds + (unknown ? 0 : bytes / kBytesPerSecond));
    limit(RLIMIT_CORE, 0);
#ifndef SRISP_SANITIZED // its own memory would not fit in
    limit(RLIMIT_DATA, kMostMemory);
#endif
}

} // namespace

Error decoder_nonsense()
{
    return { "makes its decoder answer with nonsense; it is damaged, or made to do harm" };
}

Expected<std::string> run_decoder(DecoderTask task, const std::string& path)
{
    const std::string program = own_program(kProgram).string();
    const std::string without = " (isolate=0 decodes within the calling program)";
    if (program.empty())
        return Error{ std::string("its decoder, libexec/srisp/") + kProgram + ", is not installed with this code" +
                      without };
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        return Error{ std::string("its decoder cannot be started: ") + std::strerror(errno) };
    pid_t child = -1;
    const int failed = SpawnPlan(ends[1]).start(
        child, { program.c_str(), SRISP_VERSION, kTaskNames[int(task)], path.c_str(), nullptr });
    ::close(ends[1]);
    std::string bytes = failed ? "" : read_answer(ends[0]);
    ::close(ends[0]);
    if (failed)
        return Error{ "its decoder '" + program + "' cannot be started: " + std::strerror(failed) + without };
    int status = 0;
    pid_t ended;
    do
        ended = ::waitpid(child, &status, 0);
    while (ended < 0 && errno == EINTR);
    if (!is_whole(bytes))
        return death(ended == child, status);
    const char kind = bytes[0];
    bytes.erase(0, kAnswerHead);
    if (kind == kError)
        return Error{ bytes };
    return bytes;
}

int serve_decoder(int argc, char** argv,
                  const std::function<Expected<std::string>(DecoderTask task, const std::string& path)>& decode)
{
    constexpr int kVersion = 1, kTask = 2, kPath = 3, kWords = 4;
    const auto* const task = argc == kWords
                                 ? std::find(std::begin(kTaskNames), std::end(kTaskNames), std::string(argv[kTask]))
                                 : std::end(kTaskNames);
    if (task == std::end(kTaskNames)) {
        std::fputs("srispdecode: decodes RAW files for the other programs of srisp, which start it\n", stderr);
        return 2;
    }
    limit_this_process(argv[kPath]);
    Expected<std::string> answer = Error{ "" };
    try {
        if (argv[kVersion] == std::string(SRISP_VERSION))
            answer = decode(DecoderTask(task - std::begin(kTaskNames)), argv[kPath]);
        else
            answer = Error{ "its decoder is of srisp " SRISP_VERSION ", not " + std::string(argv[kVersion]) };
    } catch (const std::bad_alloc&) {
        answer = Error{ "takes more memory to decode than such a file can need" };
    } catch (const std::exception& thrown) {
        answer = Error{ thrown.what() };
    }
    const auto to_stdout = [](const char* data, std::size_t size) { return ::write(STDOUT_FILENO, data, size); };
    return write_all(framed(answer), to_stdout) ? 0 : 1;
}

} // namespace srisp
