// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace srisp::tool {

/// What a tool's main() returns: the exit code of `body`, or that of the Failure it throws, whose message is printed
/// on stderr. After Interrupted, the program ends as the signal would have ended it. Of the message of any other
/// exception the first line is printed; LibTorch appends a stack trace.
int run_tool(const char* name, const std::function<int()>& body);

} // namespace srisp::tool
