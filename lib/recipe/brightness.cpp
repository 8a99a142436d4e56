// SPDX-License-Identifier: Apache-2.0
#include "recipe/brightness.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "base/shown_text.h"

namespace srisp {

Expected<Brightness> parse_brightness(const std::string& text)
{
    Brightness brightness;
    if (text == "sample") {
        brightness.sample = true;
        return brightness;
    }
    std::string_view digits = text;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-')
        digits.remove_prefix(1);
    const char* const end = digits.data() + digits.size();
    const auto [stop, failed] = std::from_chars(digits.data(), end, brightness.ev);
    if (digits.empty() || failed != std::errc() || stop != end || !(std::fabs(brightness.ev) <= kLargestBrightnessEv))
        return Error{ "brightness '" + shown_text(text) + "' is neither a number of EV from -20 to 20 nor 'sample'" };
    return brightness;
}

} // namespace srisp
