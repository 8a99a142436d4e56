// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

// How much memory an image may take. Most are computed in bands of rows and take little, whatever their size; this is
// about those that are held as a whole.

namespace srisp {

/// Bytes that holding so many pixels takes at most: as they are decoded, as floats, and as the file of a result.
std::uint64_t image_memory(std::uint64_t pixels, int channels);

/// Bytes that the buffers of one image may take: SRISP_MAX_MEMORY in the environment ("2G", "500M", or a number of
/// megabytes; of 2^20 bytes), without it all that this machine has. Error: it says something else.
Expected<std::uint64_t> most_image_memory();

/// Whether an image may have so many pixels in memory at a time. Errors: "takes 1.2 GB of memory …".
Status check_memory(std::uint64_t pixels, int channels);

/// The same of what an open file's reader holds: all pixels, a row of tiles, or next to nothing.
Status check_reading_memory(const char* reader, const OIIO::ImageSpec& spec);

} // namespace srisp
