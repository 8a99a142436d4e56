// SPDX-License-Identifier: Apache-2.0
#include "child_process.h"

#include <signal.h>
#include <sys/prctl.h>
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

int HeldSignals::run(const std::vector<std::string>& words, const std::vector<std::string>& environment)
{
    const std::vector<char*> arguments = pointers(words);
    const std::vector<char*> variables = pointers(environment);
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0)
        fail(std::string("cannot start a process: ") + std::strerror(errno));
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGTERM); // a killed srisptool leaves nothing running
        if (getppid() != parent)
            _exit(kExitFailed);
        sigprocmask(SIG_SETMASK, &m_before, nullptr);
        execve(arguments[0], arguments.data(), variables.data());
        const std::string message = "srisptool: cannot run '" + words[0] + "': " + std::strerror(errno) + "\n";
        _exit(write(STDERR_FILENO, message.data(), message.size()) < 0 ? 126 : 127);
    }
    return wait_for(child);
}

int HeldSignals::wait_for(int child)
{
    sigset_t awaited = m_held;
    sigaddset(&awaited, SIGCHLD);
    for (;;) {
        int status = 0;
        const pid_t ended = waitpid(child, &status, WNOHANG);
        if (ended == child && WIFEXITED(status))
            return WEXITSTATUS(status);
        if (ended == child) {
            if (sigismember(&m_held, WTERMSIG(status)))
                m_came = WTERMSIG(status);
            return 128 + WTERMSIG(status);
        }
        const int number = sigwaitinfo(&awaited, nullptr);
        if (number > 0 && number != SIGCHLD) {
            m_came = number;
            kill(child, number);
        }
    }
}

} // namespace srisp::tool
