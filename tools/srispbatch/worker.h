// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <atomic>
#include <string>
#include <vector>

#include "image_task.h"

namespace srisp::tool {

/// A process of its own that makes images, so that a photo which crashes or hangs a decoder, or makes it take all
/// memory, costs that photo alone. It is this program with the same command line and --worker, is started when it is
/// needed, and again after it has died.
class Worker {
public:
    /// `arguments`: the command line; `time_limit`: seconds for a task.
    Worker(const std::vector<std::string>& arguments, double time_limit);
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Starts the process, unless it lives: some tenths of a second pass until it can work. Errors: the system's own.
    Status start();

    /// run_task there. `reference`: SharedReference::name, or empty. Errors, beside those: it crashed, it took longer
    /// than the limit, it cannot be started.
    Expected<nlohmann::ordered_json> run(const BatchTask& task, const std::string& path, const std::string& reference,
                                         const std::string& settings, bool may_replace, const AskForMemory& ask);

    /// Ends it at once, from any thread; a `run` under way fails.
    void kill();

private:
    /// What ended it, in words.
    std::string wait_for_end();

    std::vector<std::string> m_arguments;
    const double m_time_limit;
    std::atomic<pid_t> m_process{ 0 }; ///< 0: there is none
    int m_socket = -1;                 ///< its stdin and stdout
};

/// What a worker does: the tasks that come on stdin, one after the other, until that ends.
void serve_tasks(const BatchOptions& options);

} // namespace srisp::tool
