// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>
#include <srisp/options.h>

namespace srisp {

/// From a user's text: a number of EV (`+0.5`, `-1`, `0`), or `sample`. Errors: any other text, a number beyond
/// kLargestBrightnessEv.
Expected<Brightness> parse_brightness(const std::string& text);

} // namespace srisp
