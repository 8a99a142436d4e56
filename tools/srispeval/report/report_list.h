// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "../metric_table.h"

namespace srisp::tool {

/// The table of all images, as HTML: those of `shown` first, in that order, with links to their pictures.
std::string image_table_html(const Evaluation& evaluation, const std::vector<std::size_t>& shown);

/// "picture-12", the anchor of an image's pictures.
std::string picture_anchor(std::size_t image);

/// An image's title as HTML: "a/b.dng, top".
std::string image_title(const ImageScore& image);

} // namespace srisp::tool
