// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <srisp/dng.h>

#include "base/byte_sink.h"

namespace srisp {

/// The image data of a DNG, one block after the other: strips (uncompressed), or tiles (compressed; in the layout
/// 'cinema' only two of these).
class ImageBlocks {
public:
    /// Compresses; the image must have passed `check_dng_image`, and outlive this object.
    ImageBlocks(const DngImage& image, const DngOptions& options);

    bool tiled() const { return m_options.compression != DngCompression::none; }
    int block_width() const { return m_width; }
    int block_height() const { return m_height; }
    /// Bytes of each block, row by row.
    const std::vector<std::uint32_t>& sizes() const { return m_sizes; }
    /// Bytes of each block with what follows it, so that the next one begins at an even offset.
    static std::uint64_t padded(std::uint32_t size) { return std::uint64_t(size) + size % 2; }

    void write(ByteSink& file) const;

private:
    void compress();
    std::string compressed(int left, int top) const;

    const DngImage& m_image;
    const DngOptions m_options;
    int m_width, m_height; ///< of a block
    std::vector<std::uint32_t> m_sizes;
    std::vector<std::string> m_compressed; ///< uncompressed strips are made when they are written
};

} // namespace srisp
