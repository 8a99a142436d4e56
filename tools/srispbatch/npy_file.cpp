// SPDX-License-Identifier: Apache-2.0
#include "npy_file.h"

namespace srisp::tool {

std::string npy_bytes(const Image& image, OutputDepth depth)
{
    const OIIO::ImageSpec& spec = image.spec();
    static const char* const kTypes[] = { "<f2", "<f4", "<u2" };
    static const OIIO::TypeDesc kStored[] = { OIIO::TypeHalf, OIIO::TypeFloat, OIIO::TypeUInt16 };
    std::string header = std::string("{'descr': '") + kTypes[int(depth)] + "', 'fortran_order': False, 'shape': (" +
                         std::to_string(spec.height) + ", " + std::to_string(spec.width) +
                         (spec.nchannels > 1 ? ", " + std::to_string(spec.nchannels) : "") + "), }";
    constexpr std::size_t kMagic = 10, kAlignment = 64;
    header.resize((kMagic + header.size() + 1 + kAlignment - 1) / kAlignment * kAlignment - kMagic - 1, ' ');
    header += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += char(header.size() & 255);
    bytes += char(header.size() >> 8);
    bytes += header;
    const OIIO::TypeDesc stored = kStored[int(depth)];
    const std::size_t start = bytes.size(), count = image.pixels().size();
    bytes.resize(start + count * stored.size());
    OIIO::convert_pixel_values(OIIO::TypeFloat, image.pixels().data(), stored, bytes.data() + start, int(count));
    return bytes;
}

} // namespace srisp::tool
