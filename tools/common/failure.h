// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

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

} // namespace srisp::tool
