// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "reference/decoders.h"
#include "reference/sample_layout.h"

namespace srisp {

namespace {

/// One row of samples. Packed ones: the high eight bits of each of some samples, then a byte of their low bits, the
/// first sample's lowest. [MIPI CSI-2, RAW10 and RAW12]
void unpack_row(const SampleLayout& layout, const unsigned char* source, std::uint16_t* target)
{
    const int width = layout.pixels.width;
    if (!layout.packed) {
        for (int x = 0; x < width; ++x)
            target[x] = layout.bits > 8 ? std::uint16_t(source[2 * x] | source[2 * x + 1] << 8) : source[x];
        return;
    }
    const int low_bits = layout.bits - 8, group = 8 / low_bits;
    for (int x = 0; x < width; ++x) {
        const unsigned char* bytes = source + x / group * (group + 1);
        const int low = bytes[group] >> low_bits * (x % group) & ((1 << low_bits) - 1);
        target[x] = std::uint16_t(bytes[x % group] << low_bits | low);
    }
}

} // namespace

Expected<RawImage> decode_plain_samples(const FileBytes& file, const SampleLayout& layout)
{
    const std::uint64_t width = std::uint64_t(layout.pixels.width), height = std::uint64_t(layout.pixels.height);
    const std::uint64_t needed = layout.offset + layout.row_bytes * height;
    if (needed != file.size)
        return Error{ "description '" + layout.path + "' says " + std::to_string(needed) + " bytes (offset " +
                      std::to_string(layout.offset) + ", " + std::to_string(height) + " rows of " +
                      std::to_string(layout.row_bytes) + " bytes), the file has " + std::to_string(file.size) };
    const std::shared_ptr<std::uint16_t[]> samples(new std::uint16_t[std::size_t(width * height)]);
    std::vector<std::uint16_t> largest(layout.pixels.height);
    parallel_tasks(layout.pixels.height, 0, [&](std::int64_t y) {
        std::uint16_t* row = samples.get() + std::uint64_t(y) * width;
        unpack_row(layout, file.data.get() + layout.offset + std::uint64_t(y) * layout.row_bytes, row);
        largest[std::size_t(y)] = *std::max_element(row, row + width);
    });
    const int found = *std::max_element(largest.begin(), largest.end());
    if (found >> layout.bits != 0)
        return Error{ "holds a sample of " + std::to_string(found) + ", which is more than the " +
                      std::to_string(layout.bits) + " bits that description '" + layout.path +
                      "' says: are size, offset, bits and byte order (little-endian) right?" };
    RawImage image{ layout.pixels, layout.facts, {} };
    image.notes.push_back("plain samples without a header, read as '" + layout.path + "' says");
    image.pixels.owner = samples;
    image.pixels.shorts = samples.get();
    image.pixels.row_stride = std::ptrdiff_t(width);
    return image;
}

} // namespace srisp
