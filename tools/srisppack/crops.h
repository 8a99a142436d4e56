// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <srisp/image.h>

namespace srisp::tool {

/// What is cut out of one image: the whole first, then up to `count` parts of the same proportions, each side 50 … 100
/// % of the image's, placed at random. None is smaller than `size` pixels, so that squashing it to size × size does not
/// enlarge; images that are hardly larger than that have no crops. `name` and `seed` decide, on every machine alike.
std::vector<Roi> choose_crops(int width, int height, int size, int count, std::uint64_t seed, const std::string& name);

/// As a pack states it: left, top, right, bottom, 0 … 1.
std::array<float, 4> relative_crop(const Roi& crop, int width, int height);

/// Where the pixels of an upright crop are stored; `width` and `height` of the stored image, `orientation` as in EXIF.
Roi stored_crop(const Roi& upright, int width, int height, int orientation);

/// [3, size, size] from interleaved values in [0,1], as a pack holds them.
void append_pixels(const std::vector<float>& rgb, std::vector<std::uint16_t>& pixels);

/// The largest rectangle of an image (interleaved RGB) that holds no masked pixel. Masked is what lies in a block of 3
/// × 3 pixels that are exactly zero in all channels: single zeros are dark pixels. The whole image where there is no
/// such block.
Roi largest_unmasked_part(const std::vector<float>& rgb, int width, int height);

} // namespace srisp::tool
