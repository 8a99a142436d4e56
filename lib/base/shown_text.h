// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Texts that others wrote, as messages may show them.

namespace srisp {

constexpr std::size_t kLongestShown = 120; // bytes

/// On one line, short: control characters and bytes that are no UTF-8 as \x0a, what is longer than `most` bytes cut
/// between two characters, with "…" behind it.
std::string shown_text(std::string_view text, std::size_t most = kLongestShown);

/// A number with up to so many significant digits. A point stands before its fraction, whatever a host's locale says.
std::string shown_number(double value, int digits = 6);
/// The same with so many digits behind the point.
std::string shown_decimals(double value, int decimals);

/// The same text where it is UTF-8; bytes that are none as \xff. For messages on their way out: they hold file names,
/// which may be any bytes, and hosts such as Python take nothing but UTF-8.
std::string valid_utf8(std::string_view text);

/// The first `count` characters; a byte that is no UTF-8 counts as one.
std::string_view first_characters(std::string_view text, std::size_t count);

} // namespace srisp
