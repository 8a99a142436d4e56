// SPDX-License-Identifier: Apache-2.0
#include "npy_file.h"

#include <string>

namespace srisp::tool {

NpyEncoder::NpyEncoder(const OIIO::ImageSpec& image, OutputDepth depth)
    : m_row(std::size_t(image.width) * std::size_t(image.nchannels))
{
    static const char* const kTypes[] = { "<f2", "<f4", "<u2" };
    static const OIIO::TypeDesc kStored[] = { OIIO::TypeHalf, OIIO::TypeFloat, OIIO::TypeUInt16 };
    m_type = kStored[int(depth)];
    std::string header = std::string("{'descr': '") + kTypes[int(depth)] + "', 'fortran_order': False, 'shape': (" +
                         std::to_string(image.height) + ", " + std::to_string(image.width) +
                         (image.nchannels > 1 ? ", " + std::to_string(image.nchannels) : "") + "), }";
    constexpr std::size_t kMagic = 10, kAlignment = 64;
    header.resize((kMagic + header.size() + 1 + kAlignment - 1) / kAlignment * kAlignment - kMagic - 1, ' ');
    header += '\n';
    const std::string start =
        std::string("\x93NUMPY\x01\x00", 8) + char(header.size() & 255) + char(header.size() >> 8) + header;
    m_bytes.reserve(start.size() + m_row * std::size_t(image.height) * m_type.size());
    m_bytes.assign(start.begin(), start.end());
}

void NpyEncoder::add_rows(const float* rows, int count)
{
    const std::size_t at = m_bytes.size(), values = m_row * std::size_t(count);
    m_bytes.resize(at + values * m_type.size());
    OIIO::convert_pixel_values(OIIO::TypeFloat, rows, m_type, m_bytes.data() + at, int(values));
}

} // namespace srisp::tool
