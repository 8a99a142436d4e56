// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "scores.h"

namespace srisp::tool {

/// Which images a report shows with pictures, the worst first: by the last method's PSNR, without a truth by its Lab
/// intersection. Where not all fit, the ten worst, and others that are evenly spread over the rest.
std::vector<std::size_t> shown_images(const Evaluation& evaluation, std::size_t most);

/// The longest side of pictures, pixels, with which a report of so many images with so many methods, of which so many
/// are shown, has so many MB; 64 to 320.
int picture_side(std::size_t images, std::size_t shown, std::size_t methods, double megabytes);

} // namespace srisp::tool
