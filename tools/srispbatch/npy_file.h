// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <OpenImageIO/imageio.h>

#include "batch_options.h"

namespace srisp::tool {

/// The bytes of a NumPy file, format 1.0, made from rows that come one after the other: an array of height × width ×
/// channels, of one channel height × width; C order, little endian. Of uint16, values are times 65535.
class NpyEncoder {
public:
    NpyEncoder(const OIIO::ImageSpec& image, OutputDepth depth);

    /// The next rows, all channels as float.
    void add_rows(const float* rows, int count);
    std::vector<unsigned char> take() { return std::move(m_bytes); }

private:
    OIIO::TypeDesc m_type;
    std::size_t m_row; ///< values
    std::vector<unsigned char> m_bytes;
};

} // namespace srisp::tool
