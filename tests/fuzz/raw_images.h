// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "base/file_bytes.h"
#include "fuzz_target.h"
#include "reference/raw_pixels.h"

namespace srisp::fuzz {

/// The bytes of a file in an allocation of their exact size.
inline FileBytes file_of(const std::uint8_t* data, std::size_t size)
{
    std::shared_ptr<unsigned char[]> copy(new unsigned char[size]);
    std::copy_n(data, size, copy.get());
    return { copy, size };
}

/// Whether an image is one of the few on which time is spent; its first sample decides.
inline bool is_looked_at_closely(const RawImage& image)
{
    const RawPixels& pixels = image.pixels;
    return pixels.shorts ? pixels.shorts[0] % 16 == 0 : std::fmod(pixels.floats[0] * 64, 4) < 1;
}

/// What every decoder promises of an image: levels that can be used, and values in [0,1].
inline void check_raw_image(const RawImage& image)
{
    const RawPixels& pixels = image.pixels;
    must_hold(bool(check_levels(pixels)), "a decoded image has usable levels");
    must_hold(bool(check_filters(pixels)), "a decoded image has usable filters");
    must_hold(pixels.width > 0 && pixels.height > 0, "a decoded image has pixels");
    must_hold(bool(pixels.shorts) != bool(pixels.floats), "samples are of one type");
    std::vector<float> row(std::size_t(pixels.width) * std::size_t(pixels.channels));
    const RowScaler scaler(pixels);
    for (int y = 0; y < pixels.height; ++y) {
        scaler.scale(y, row.data());
        must_be_in_unit_range(row, "values are in [0,1]");
    }
    if (is_looked_at_closely(image))
        must_be_in_unit_range(raw_thumbnail(pixels).rgb, "a thumbnail's values are in [0,1]");
    for (const std::string& note : image.notes)
        check_message(note);
}

} // namespace srisp::fuzz
