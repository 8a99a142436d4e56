// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "../metric_table.h"
#include "../score_words.h"

// Texts and numbers for HTML. Whatever comes from outside (names of files, cameras, converters; notes; parameters) goes
// through html().

namespace srisp::tool {

constexpr char kNothing[] = "–"; ///< where there is no number

/// A text as HTML shows it, also between quotes. Control characters and bytes that are no UTF-8 become \xff.
std::string html(std::string_view text);

/// "31.42", "−0.310" with a real minus sign; kNothing for what is no number.
std::string number(double value, int digits);
/// The same with a sign in front, "+1.20" or "−1.20"; "0.00" has none.
std::string signed_number(double value, int digits);
/// For coordinates: as few characters as tell a tenth.
std::string coordinate(double value);

/// "30.90 to 31.90".
std::string range_text(const Interval& interval, int digits);
/// The same with signs.
std::string signed_range_text(const Interval& interval, int digits);

/// "PSNR (dB)".
std::string title_with_unit(const Metric& metric);

} // namespace srisp::tool
