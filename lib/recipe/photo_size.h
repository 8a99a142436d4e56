// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <srisp/expected.h>

namespace srisp {

/// Width and height in pixels.
struct PhotoSize {
    int width, height;
};

/// A rectangle of pixels.
struct PhotoPart {
    int x, y, width, height;
};

/// What Options::resize may say: `N`, `WxH`, `Wx0`, `0xH`, `P%`. Errors: any other text, a side above 65,535.
Status check_resize(const std::string& text);

/// What Options::crop may say: `N`, `WxH`, `random:N`, `random:WxH`. Errors: any other text.
Status check_crop(const std::string& text);

/// The size of a photo after `resize`, which check_resize has seen; at least one pixel each way.
PhotoSize resized(const std::string& resize, PhotoSize photo);

/// The part of a photo that `crop` leaves, which check_crop has seen; a random one is decided by `seed`. Error: the
/// photo is smaller.
Expected<PhotoPart> cropped(const std::string& crop, PhotoSize photo, std::uint64_t seed);

} // namespace srisp
