// SPDX-License-Identifier: Apache-2.0
#include "recipe/brightness.h"

#include <cmath>
#include <string_view>

#include "base/parsed_number.h"
#include "base/shown_text.h"

namespace srisp {

Expected<Brightness> parse_brightness(const std::string& text)
{
    Brightness brightness;
    if (text == "sample") {
        brightness.sample = true;
        return brightness;
    }
    const auto ev = parsed_signed_number<decltype(brightness.ev)>(text);
    if (!ev || std::fabs(*ev) > kLargestBrightnessEv)
        return Error{ "brightness '" + shown_text(text) + "' is neither a number of EV from -20 to 20 nor 'sample'" };
    brightness.ev = *ev;
    return brightness;
}

} // namespace srisp
