// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace srisp::tool {

/// The words as one line that a POSIX shell reads back to the same words.
std::string shell_line(const std::vector<std::string>& words);

} // namespace srisp::tool
