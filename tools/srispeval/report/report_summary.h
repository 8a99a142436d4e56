// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "../metric_table.h"

namespace srisp::tool {

/// Means and differences of all methods, in tables for each rendering, and what the measures are. As HTML.
std::string summary_html(const Evaluation& evaluation);

/// The same for each camera, with the measures that matter most. Empty where no group is about one.
std::string camera_tables_html(const Evaluation& evaluation);

} // namespace srisp::tool
