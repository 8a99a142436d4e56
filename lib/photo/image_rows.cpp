// SPDX-License-Identifier: Apache-2.0
#include "photo/image_rows.h"

#include <cstring>
#include <memory>

#include "container/image_limits.h"

namespace srisp {

/// Whole rows of tiles are read; those asked for are copied.
static bool read_tile_rows(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, ImageLevel level, int y0, int y1,
                           OIIO::TypeDesc type, void* rows)
{
    const int tile = spec.tile_height;
    const int first = y0 / tile * tile;
    const int end = std::min(first + rows_in_tiles(y1 - first, spec), spec.height);
    const std::size_t row = std::size_t(spec.width) * std::size_t(spec.nchannels) * type.size();
    const std::unique_ptr<unsigned char[]> tiles(new unsigned char[row * std::size_t(end - first)]);
    if (!input.read_tiles(level.subimage, level.miplevel, spec.x, spec.x + spec.width, spec.y + first, spec.y + end,
                          spec.z, spec.z + 1, 0, spec.nchannels, type, tiles.get()))
        return false;
    std::memcpy(rows, tiles.get() + row * std::size_t(y0 - first), row * std::size_t(y1 - y0));
    return true;
}

bool read_image_rows(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, ImageLevel level, int y0, int y1,
                     OIIO::TypeDesc type, void* rows)
{
    if (spec.tile_width)
        return read_tile_rows(input, spec, level, y0, y1, type, rows);
    return input.read_scanlines(level.subimage, level.miplevel, spec.y + y0, spec.y + y1, spec.z, 0, spec.nchannels,
                                type, rows);
}

} // namespace srisp
