// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>

#include <srisp/expected.h>

namespace srisp::tool {

/// Thrown inside a tool, caught by its main(): what to print on stderr, and the exit code.
struct Failure {
    int exit_code;
    std::string message;
};

constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;

[[noreturn]] inline void fail(const std::string& message)
{
    throw Failure{ kExitFailed, message };
}
[[noreturn]] inline void fail_usage(const std::string& message)
{
    throw Failure{ kExitUsage, message };
}

/// The value, or a Failure with the error's message.
template<class T> T require(Expected<T> result)
{
    if (!result)
        fail(result.error().message);
    return std::move(*result);
}

inline void require(const Status& status)
{
    if (!status)
        fail(status.error().message);
}

/// A write beyond the limit for files fails, as on a full disk, instead of ending the program without a word; programs
/// that it starts inherit that. `restore_file_limit_signal` undoes it.
void ignore_file_limit_signal();
void restore_file_limit_signal();

/// What a tool's main() returns: the exit code of `body`, or that of the Failure it throws, whose message is printed
/// on stderr. After Interrupted, the program ends as the signal would have ended it. Of the message of any other
/// exception the first line is printed; LibTorch appends a stack trace. The signal for files that grow too large is
/// ignored.
int run_tool(const char* name, const std::function<int()>& body);

} // namespace srisp::tool
