// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

// How large an image may be: what a file says of its size is checked here, once, before anything is computed from it or
// allocated for it. Within these limits a row fits an int, and so do sums and round-ups of rows and columns; products
// of more are computed in 64 bits.

namespace srisp {

constexpr int kLargestSide = 1 << 20;
constexpr int kMostChannels = 1024;

/// Width and height, before a spec is there. Errors: "has 0 x 0 pixels; …"; more than 2,000 million, or the million
/// times that SRISP_MAX_MEGAPIXELS in the environment says; that says something else.
Status check_sides(std::uint64_t width, std::uint64_t height);

/// Sizes of image, tiles and windows; the same errors.
Status check_size(const OIIO::ImageSpec& spec);

/// Whether a file of so many bytes can hold so many pixels: each format's compression has an end. `reader`: that of the
/// file. Small images are not asked.
Status check_claim(const char* reader, std::uint64_t width, std::uint64_t height, std::uint64_t file_bytes);

/// OpenImageIO reads so many rows at a time as a TIFF says that a strip has, whatever the number is, in ints: at most
/// all rows from here on.
void limit_strips(OIIO::ImageSpec& spec);

/// Rows of at most so many pixels, but of a small image one of `parts`: memory that was not used before takes longer to
/// come than what is computed in it, and the next part uses it again.
std::int64_t rows_of_part(std::int64_t most_pixels, const OIIO::ImageSpec& spec, int parts);

/// Rows that are read at a time: `wanted` rounded up to whole tiles, at most the image's.
int rows_in_tiles(std::int64_t wanted, const OIIO::ImageSpec& spec);

} // namespace srisp
