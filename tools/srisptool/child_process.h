// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <signal.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace srisp::tool {

/// Replaces this process by the program; `words[0]` is its file. Fails if it cannot be run.
[[noreturn]] void become(const std::vector<std::string>& words, const std::vector<std::string>& environment);

/// What a child writes to one of its streams.
struct Listener {
    int stream; ///< 1 or 2
    std::function<void(std::string_view)> take;
};

/// Keeps SIGINT, SIGTERM, SIGHUP and SIGQUIT from ending this process while the object lives, so that what was begun
/// can be cleaned up; those that were ignored stay ignored.
class HeldSignals {
public:
    HeldSignals();
    /// Lets them through again; one that came ends the process here, as it would have without this object.
    ~HeldSignals();
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

    /// Runs the program and waits for its end; a held signal is passed on to it. The listener gets at once what the
    /// program writes. Returns its exit code, 128 + n if signal n ended it.
    int run(const std::vector<std::string>& words, const std::vector<std::string>& environment,
            const Listener& listener);

private:
    int wait_for(int child, int pipe, const Listener& listener);

    sigset_t m_held, m_before;
    int m_came = 0;
};

} // namespace srisp::tool
