// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "report_page.h"

namespace srisp::tool {

/// The pictures of all images in `shown` with their numbers and parameters, as HTML, one after the other.
void write_images(const Evaluation& evaluation, const std::vector<std::size_t>& shown,
                  const std::function<Expected<ImagePictures>(std::size_t)>& pictures, ByteSink& out);

} // namespace srisp::tool
