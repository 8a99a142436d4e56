// SPDX-License-Identifier: Apache-2.0
#include "photo/image_rows.h"

#include <algorithm>
#include <vector>

namespace srisp {

/// Whole rows of tiles are read; those asked for are copied.
static bool read_tile_rows(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int subimage, int miplevel, int y0,
                           int y1, float* rows)
{
    const int tile = spec.tile_height;
    const int first = y0 / tile * tile, last = std::min((y1 + tile - 1) / tile * tile, spec.height);
    const std::size_t row = std::size_t(spec.width) * spec.nchannels;
    std::vector<float> tiles(row * (last - first));
    if (!input.read_tiles(subimage, miplevel, spec.x, spec.x + spec.width, spec.y + first, spec.y + last, spec.z,
                          spec.z + 1, 0, spec.nchannels, OIIO::TypeFloat, tiles.data()))
        return false;
    std::copy_n(tiles.data() + row * (y0 - first), row * (y1 - y0), rows);
    return true;
}

bool read_image_rows(OIIO::ImageInput& input, int subimage, int miplevel, int y0, int y1, float* rows)
{
    const OIIO::ImageSpec spec = input.spec_dimensions(subimage, miplevel);
    if (spec.tile_width)
        return read_tile_rows(input, spec, subimage, miplevel, y0, y1, rows);
    return input.read_scanlines(subimage, miplevel, spec.y + y0, spec.y + y1, spec.z, 0, spec.nchannels,
                                OIIO::TypeFloat, rows);
}

} // namespace srisp
