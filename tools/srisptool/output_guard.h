// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace srisp::tool {

/// Environment variable with the path of the file that the guard adds the names of unfinished outputs to.
constexpr char kGuardListVariable[] = "SRISP_GUARD_LIST";

} // namespace srisp::tool
