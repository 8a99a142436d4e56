// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <srisp/image.h>

namespace srisp::tool {

/// The largest rectangle of an image (interleaved RGB) that holds no masked pixel. Masked is what lies in a block of 3
/// × 3 pixels that are exactly zero in all channels: single zeros are dark pixels. The whole image where there is no
/// such block.
Roi largest_unmasked_part(const std::vector<float>& rgb, int width, int height);

} // namespace srisp::tool
