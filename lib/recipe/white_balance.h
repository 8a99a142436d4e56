// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>
#include <srisp/options.h>

namespace srisp {

/// From a user's text: `scene`, `reference`, `5600`, `5600,10` (kelvin, tint), `2.1,1,1.6` (multipliers of R, G, B).
/// Errors: any other text, numbers out of range.
Expected<WhiteBalance> parse_white_balance(const std::string& text);

/// A number of EV from −20 to 20. Error: any other text.
Expected<double> parse_exposure(const std::string& text);

} // namespace srisp
