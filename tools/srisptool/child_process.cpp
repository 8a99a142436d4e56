// SPDX-License-Identifier: Apache-2.0
#include "child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "../common/failure.h"

namespace srisp::tool {

namespace {

std::vector<char*> pointers(const std::vector<std::string>& words)
{
    std::vector<char*> result;
    for (const std::string& word : words)
        result.push_back(const_cast<char*>(word.c_str()));
    result.push_back(nullptr);
    return result;
}

} // namespace

[[noreturn]] void become(const std::vector<std::string>& words, const std::vector<std::string>& environment)
{
    execve(words[0].c_str(), pointers(words).data(), pointers(environment).data());
    fail("cannot run '" + words[0] + "': " + std::strerror(errno));
}

HeldSignals::HeldSignals()
{
    sigemptyset(&m_held);
    for (const int number : { SIGINT, SIGTERM, SIGHUP, SIGQUIT }) {
        struct sigaction action;
        if (sigaction(number, nullptr, &action) == 0 && action.sa_handler != SIG_IGN)
            sigaddset(&m_held, number);
    }
    signal(SIGCHLD, SIG_DFL); // ignored, there would be no exit code to wait for
    sigset_t blocked = m_held;
    sigaddset(&blocked, SIGCHLD);
    sigprocmask(SIG_BLOCK, &blocked, &m_before);
}

HeldSignals::~HeldSignals()
{
    if (m_came != 0)
        kill(getpid(), m_came);
    sigprocmask(SIG_SETMASK, &m_before, nullptr); // here it ends, if a signal came
}

int HeldSignals::run(const std::vector<std::string>& words, const std::vector<std::string>& environment,
                     const Listener& listener)
{
    const std::vector<char*> arguments = pointers(words);
    const std::vector<char*> variables = pointers(environment);
    const pid_t parent = getpid();
    int ends[2];
    const bool piped = pipe2(ends, O_CLOEXEC) == 0;
    const pid_t child = piped ? fork() : -1;
    if (child < 0)
        fail(std::string("cannot start a process: ") + std::strerror(errno));
    if (child == 0) {
        dup2(ends[1], listener.stream);
        prctl(PR_SET_PDEATHSIG, SIGTERM); // a killed srisptool leaves nothing running
        if (getppid() != parent)
            _exit(kExitFailed);
        sigprocmask(SIG_SETMASK, &m_before, nullptr);
        execve(arguments[0], arguments.data(), variables.data());
        const std::string message = "srisptool: cannot run '" + words[0] + "': " + std::strerror(errno) + "\n";
        _exit(write(STDERR_FILENO, message.data(), message.size()) < 0 ? 126 : 127);
    }
    close(ends[1]);
    return wait_for(child, ends[0], listener);
}

int HeldSignals::wait_for(int child, int pipe, const Listener& listener)
{
    sigset_t awaited = m_held;
    sigaddset(&awaited, SIGCHLD);
    const int signals = signalfd(-1, &awaited, SFD_CLOEXEC | SFD_NONBLOCK);
    if (signals < 0)
        fail(std::string("cannot wait for a process: ") + std::strerror(errno));
    fcntl(pipe, F_SETFL, O_NONBLOCK);
    const auto listen = [&] {
        char bytes[4096];
        for (;;) {
            const ssize_t count = read(pipe, bytes, sizeof bytes);
            if (count > 0)
                listener.take({ bytes, std::size_t(count) });
            else
                return count < 0 && (errno == EAGAIN || errno == EINTR); // else the other end is closed
        }
    };
    pollfd awake[] = { { signals, POLLIN, 0 }, { pipe, POLLIN, 0 } };
    for (int status = 0;;) {
        const bool ended = waitpid(child, &status, WNOHANG) == child;
        if (!listen())
            awake[1].fd = -1;
        if (ended) {
            close(signals);
            close(pipe);
            if (WIFEXITED(status))
                return WEXITSTATUS(status);
            if (sigismember(&m_held, WTERMSIG(status)))
                m_came = WTERMSIG(status);
            return 128 + WTERMSIG(status);
        }
        poll(awake, 2, -1);
        for (signalfd_siginfo info; read(signals, &info, sizeof info) == sizeof info;)
            if (info.ssi_signo != SIGCHLD) {
                m_came = static_cast<int>(info.ssi_signo);
                kill(child, m_came);
            }
    }
}

} // namespace srisp::tool
