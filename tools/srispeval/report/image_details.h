// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "../metric_table.h"

namespace srisp::tool {

/// An image's numbers for each method, its notes, and what each method chose for it. As HTML.
std::string image_details_html(const Evaluation& evaluation, const ImageScore& image);

/// Parameters for reading: JSON with a list of numbers on one line and few digits. Not escaped. What is no JSON stays
/// as it is.
std::string readable_parameters(const std::string& json_text);

/// The heaviest of each list of weights in parameters: "tone 1: 62 % of no. 3, 21 % of no. 0". As HTML; empty where
/// there are none.
std::string weights_html(const std::string& json_text);

} // namespace srisp::tool
