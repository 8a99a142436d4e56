// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "../metric_table.h"

namespace srisp::tool {

/// All charts as HTML with SVG in it, one rendering after the other.
std::string charts_html(const Evaluation& evaluation);

} // namespace srisp::tool
