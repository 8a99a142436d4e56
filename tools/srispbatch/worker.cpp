// SPDX-License-Identifier: Apache-2.0
#include "worker.h"

#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "../common/own_location.h"
#include "base/json_text.h"
#include "messages.h"
#include "task_message.h"

extern char** environ;

namespace srisp::tool {

using nlohmann::ordered_json;

Worker::Worker(const std::vector<std::string>& arguments, double time_limit)
    : m_arguments(arguments), m_time_limit(time_limit)
{
    m_arguments.insert(m_arguments.begin(), { own_executable().string(), "--worker" });
}

Worker::~Worker()
{
    if (m_process)
        wait_for_end();
}

void Worker::kill()
{
    if (const pid_t process = m_process)
        ::kill(process, SIGKILL);
}

Status Worker::start()
{
    if (m_process)
        return {};
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        return Error{ std::strerror(errno) };
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int file : { STDIN_FILENO, STDOUT_FILENO })
        posix_spawn_file_actions_adddup2(&actions, ends[1], file);
    std::vector<char*> arguments;
    for (std::string& argument : m_arguments)
        arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    pid_t process = 0;
    const int failed = ::posix_spawn(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (failed) {
        ::close(ends[0]);
        return Error{ std::strerror(failed) };
    }
    m_socket = ends[0];
    m_process = process;
    return {};
}

std::string Worker::wait_for_end()
{
    // It ends when it finds its input closed, if it still lives.
    ::close(std::exchange(m_socket, -1));
    int status = 0;
    while (::waitpid(m_process, &status, 0) < 0 && errno == EINTR) {
    }
    m_process = 0;
    if (WIFSIGNALED(status))
        return std::string("crashed the decoder (") + ::strsignal(WTERMSIG(status)) + ")";
    return "ended the decoder with exit code " + std::to_string(WEXITSTATUS(status));
}

Expected<ordered_json> Worker::run(const BatchTask& task, const std::string& path, const std::string& reference,
                                   const std::string& settings, bool may_replace, const AskForMemory& ask)
{
    const std::string photo = "photo '" + task.photo.path + "': ";
    if (const Status started = start(); !started)
        return Error{ photo + "a process for it cannot be started: " + started.error().message };
    bool timed_out = false;
    std::optional<Message> answer;
    bool heard = send_message(m_socket, task_message({ task, path, reference, settings, may_replace }));
    if (heard && (answer = receive_message(m_socket, m_time_limit, timed_out)) && answer->size() == 1) {
        ask(std::strtoull((*answer)[0].c_str(), nullptr, 10));
        heard = send_message(m_socket, { "go on" });
        answer = heard ? receive_message(m_socket, m_time_limit, timed_out) : std::nullopt;
    }
    if (answer && answer->size() == 2) {
        const auto& [kind, text] = std::make_pair((*answer)[0], (*answer)[1]);
        if (kind == kTaskFailed)
            return Error{ text };
        if (const auto line = parse_json<ordered_json>(text))
            return *line;
    }
    if (timed_out) {
        kill();
        wait_for_end();
        return Error{ photo + "took longer than " + std::to_string(long(m_time_limit)) + " s (--time-limit)" };
    }
    kill(); // whatever it waits for
    return Error{ photo + wait_for_end() };
}

} // namespace srisp::tool
