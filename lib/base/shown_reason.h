// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace srisp {

constexpr std::size_t kLongestReason = 600; // bytes

/// What a library says is wrong with a file, as messages may show it: shown_text, for it quotes what files hold
/// (OpenEXR whole channel names), with "; " between its lines. Readers end some messages with a line's end, and add one
/// of their own for each layer.
std::string shown_reason(std::string reason);

} // namespace srisp
