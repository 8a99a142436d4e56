// SPDX-License-Identifier: Apache-2.0
#include "converter.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <thread>
#include <vector>

#include "../common/interrupt.h"

extern char** environ;

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr auto kLongest = std::chrono::minutes(10);

/// The command line, and where the photo will be.
struct Conversion {
    std::vector<std::string> words;
    fs::path photo;
    bool on_stdout = false;
};

Conversion conversion(const std::string& program, const std::string& raw, const fs::path& folder)
{
    if (program == "dcraw")
        return { { program, "-c", raw }, folder / "photo.ppm", true };
    const fs::path photo = folder / "photo.tif";
    if (program == "rawtherapee-cli")
        return { { program, "-q", "-Y", "-t", "-b8", "-o", photo.string(), "-c", raw }, photo };
    return { { program, raw, photo.string(), "--core", "--configdir", (folder / "config").string(), "--library",
               ":memory:" },
             photo };
}

/// Starts a program in a process group of its own, its output thrown away or into a file. 0, or an errno.
int start(const Conversion& conversion, pid_t& child)
{
    std::vector<char*> words;
    for (const std::string& word : conversion.words)
        words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(
        &files, STDOUT_FILENO, conversion.on_stdout ? conversion.photo.c_str() : "/dev/null", O_WRONLY | O_CREAT, 0600);
    ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int failed = ::posix_spawnp(&child, words[0], &files, &attributes, words.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&files);
    return failed;
}

/// Waits for the end of a program; what takes too long is killed.
int wait_for(pid_t child)
{
    using namespace std::chrono_literals;
    const auto end = Clock::now() + kLongest;
    int status = 0;
    while (::waitpid(child, &status, WNOHANG) == 0) {
        if (pending_interrupt() || Clock::now() > end) {
            ::kill(-child, SIGKILL);
            ::waitpid(child, &status, 0);
            return status;
        }
        std::this_thread::sleep_for(10ms);
    }
    return status;
}

} // namespace

bool is_installed(const std::string& program)
{
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (::access((fs::path(folder) / program).c_str(), X_OK) == 0)
            return true;
    return false;
}

Expected<std::string> convert_raw(const std::string& program, const std::string& raw, const fs::path& folder)
{
    std::error_code error;
    const Conversion job = conversion(program, fs::absolute(raw, error).string(), folder);
    pid_t child = -1;
    if (const int failed = start(job, child))
        return Error{ program + " cannot be started: " + std::strerror(failed) };
    const int status = wait_for(child);
    if (WIFSIGNALED(status))
        return Error{ program + " was ended by a signal: " + ::strsignal(WTERMSIG(status)) };
    if (WEXITSTATUS(status) != 0)
        return Error{ program + " ended with exit code " + std::to_string(WEXITSTATUS(status)) };
    if (!fs::exists(job.photo, error) || fs::file_size(job.photo, error) == 0)
        return Error{ program + " wrote no photo" };
    return job.photo.string();
}

} // namespace srisp::tool
