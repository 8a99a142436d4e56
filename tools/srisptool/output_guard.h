// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace srisp::tool {

/// Environment variable with the path of the file that the guard adds the names of unfinished outputs to.
constexpr char kGuardListVariable[] = "SRISP_GUARD_LIST";

/// Environment variable with the number of the stream that messages go to.
constexpr char kGuardStreamVariable[] = "SRISP_GUARD_STREAM";

/// How the line begins there that tells of the first write that failed: behind it the reason, ": ", and the path.
constexpr char kGuardFailure[] = "srisp output guard: ";

} // namespace srisp::tool
