// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "../metric_table.h"

// Charts of single images' scores. `images`: those of one rendering. Each is empty where there is nothing to show.

namespace srisp::tool {

/// How many images have which value, a panel for each method.
std::string histogram(const std::vector<const ImageScore*>& images, const std::vector<std::string>& methods,
                      const Metric& metric);

/// Mean colours of references, truths and results, a panel for each method.
std::string chromaticity_plot(const std::vector<const ImageScore*>& images, const std::vector<std::string>& methods);

} // namespace srisp::tool
