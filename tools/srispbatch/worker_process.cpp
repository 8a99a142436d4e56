// SPDX-License-Identifier: Apache-2.0
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <new>

#include "../common/machine_share.h"
#include "messages.h"
#include "shared_references.h"
#include "task_message.h"
#include "worker.h"

namespace srisp::tool {

namespace {

constexpr double kForever = 1e9; // seconds

/// What comes from the terminal is for the process that this one works for; with that one it ends.
void follow_the_other_process()
{
    for (const int signal : { SIGINT, SIGTERM, SIGHUP })
        std::signal(signal, SIG_IGN);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
}

/// A decoder that asks for more memory than all photos may take together is refused it, unless its photo's header says
/// that it takes so much, `bytes`: then it is made alone.
void limit_memory(const BatchOptions& options, std::uint64_t bytes)
{
    constexpr rlim_t kOwn = rlim_t(1) << 30; // model, references, libraries
    rlimit limit{};
    if (::getrlimit(RLIMIT_DATA, &limit) != 0)
        return;
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, rlim_t(std::max(memory_limit(options.memory_gb), bytes)) + kOwn);
    ::setrlimit(RLIMIT_DATA, &limit);
}

Message answer_to(const WorkerTask& task, const BatchOptions& options, int from, int to)
{
    take_shared_reference(task.reference, task.task.reference);
    const AskForMemory ask = [&](std::uint64_t bytes) {
        bool timed_out = false;
        if (!send_message(to, { std::to_string(bytes) }) || !receive_message(from, kForever, timed_out))
            ::_exit(1); // nobody waits for this image
        limit_memory(options, bytes);
    };
    const std::string photo = "photo '" + task.task.photo.path + "': ";
    try {
        const auto line = run_task(task.task, task.path, options, task.settings, task.may_replace, ask);
        if (line)
            return { kTaskDone, line->dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace) };
        return { kTaskFailed, line.error().message };
    } catch (const std::bad_alloc&) {
        return { kTaskFailed, photo + "takes more memory than its size explains (--memory)" };
    } catch (const std::exception& error) {
        return { kTaskFailed, photo + error.what() };
    }
}

} // namespace

void serve_tasks(const BatchOptions& options)
{
    follow_the_other_process();
    limit_memory(options, 0);
    prepare_making(options.format, most_references(options.memory_gb, images_at_a_time(options.threads)));
    // What a library prints on stdout is none of the answers.
    const int to = ::dup(STDOUT_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    bool timed_out = false;
    while (const auto message = receive_message(STDIN_FILENO, kForever, timed_out)) {
        const auto task = task_of_message(*message);
        if (!task || !send_message(to, answer_to(*task, options, STDIN_FILENO, to)))
            return;
    }
}

} // namespace srisp::tool
