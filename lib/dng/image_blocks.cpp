// SPDX-License-Identifier: Apache-2.0
#include "dng/image_blocks.h"

#include <algorithm>
#include <new>

#include <zlib.h>

#include "base/parallel.h"
#include "dng/lossless_jpeg.h"
#include "dng/packed_rows.h"

namespace srisp {

namespace {

constexpr int kTile = 512;          // pixels a side
constexpr int kTileMultiple = 16;   // TIFF 6.0, section 15
constexpr int kLargestTile = 65520; // a JPEG's sides have 16 bits
constexpr std::size_t kStripBytes = std::size_t(1) << 20;

int rounded_up(int value, int multiple)
{
    return (value + multiple - 1) / multiple * multiple;
}

/// Not wider than the image, and not half as wide: dcraw and LibRaw misread such tiles.
int tile_width(int width, int most)
{
    const int tile = std::min(most, width % kTileMultiple == 0 ? width : rounded_up((width + 1) / 2, kTileMultiple));
    return 2 * tile == width ? tile - kTileMultiple : tile;
}

/// Two tiles at least: dcraw and LibRaw take one alone for a strip as wide as the image.
int tile_height(int height, int most, bool whole_rows)
{
    const int tile = std::min(most, rounded_up(height, kTileMultiple));
    return whole_rows && tile >= height ? rounded_up((height + 1) / 2, kTileMultiple) : tile;
}

/// Copies a tile; beyond the image its last pixels are repeated, a mosaic's last two, so that colours stay in place.
template<class Sample>
std::vector<Sample> tile_samples(const DngImage& image, const Sample* samples, int left, int top, int width, int height)
{
    const int period = image.planes == 1 ? 2 : 1;
    const auto inside = [period](int at, int size) { return at < size ? at : size - period + (at - size) % period; };
    const auto planes = std::size_t(image.planes);
    std::vector<Sample> tile;
    tile.reserve(std::size_t(width) * std::size_t(height) * planes);
    for (int y = 0; y < height; ++y) {
        const Sample* row = samples + inside(top + y, image.height) * image.row_stride;
        const int end = std::min(left + width, image.width);
        tile.insert(tile.end(), row + std::size_t(left) * planes, row + std::size_t(end) * planes);
        for (int x = end; x < left + width; ++x)
            for (std::size_t plane = 0; plane < planes; ++plane)
                tile.push_back(row[std::size_t(inside(x, image.width)) * planes + plane]);
    }
    return tile;
}

std::string deflated(const std::string& data)
{
    uLongf size = compressBound(uLong(data.size()));
    std::string result(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
                  uLong(data.size()), Z_DEFAULT_COMPRESSION) != Z_OK)
        throw std::bad_alloc();
    result.resize(size);
    return result;
}

} // namespace

ImageBlocks::ImageBlocks(const DngImage& image, const DngOptions& options)
    : m_image(image), m_options(options), m_width(image.width), m_height(image.height)
{
    if (options.compression != DngCompression::none) {
        const int most = options.layout == DngLayout::cinema ? kLargestTile : kTile;
        m_width = tile_width(image.width, most);
        m_height = tile_height(image.height, most, m_width == image.width);
        compress();
        return;
    }
    const std::size_t row = packed_row_bytes(std::size_t(image.width) * std::size_t(image.planes), options.bits);
    // Strips of an even number of rows follow each other without gaps: LibRaw reads on where one ends.
    m_height = int(std::min(std::max(kStripBytes / row, std::size_t(1)) * 2, std::size_t(image.height)));
    for (int y = 0; y < image.height; y += m_height)
        m_sizes.push_back(std::uint32_t(row * std::size_t(std::min(m_height, image.height - y))));
}

void ImageBlocks::compress()
{
    const int columns = (m_image.width - 1) / m_width + 1, rows = (m_image.height - 1) / m_height + 1;
    m_compressed.resize(std::size_t(columns) * std::size_t(rows));
    parallel_tasks(std::int64_t(m_compressed.size()), m_options.threads, [&](std::int64_t i) {
        m_compressed[std::size_t(i)] = compressed(int(i % columns) * m_width, int(i / columns) * m_height);
    });
    for (const std::string& block : m_compressed)
        m_sizes.push_back(std::uint32_t(block.size()));
}

std::string ImageBlocks::compressed(int left, int top) const
{
    const int planes = m_image.planes;
    if (m_image.shorts) {
        const std::vector<std::uint16_t> tile = tile_samples(m_image, m_image.shorts, left, top, m_width, m_height);
        // Of a mosaic two neighbours make a column of the JPEG.
        return encode_lossless_jpeg(
            { tile.data(), planes == 1 ? m_width / 2 : m_width, m_height, planes == 1 ? 2 : planes, m_options.bits });
    }
    const std::vector<float> tile = tile_samples(m_image, m_image.floats, left, top, m_width, m_height);
    const std::size_t row_samples = std::size_t(m_width) * std::size_t(planes);
    const std::size_t bytes = std::size_t(m_options.bits) / 8;
    std::string data;
    data.reserve(tile.size() * bytes);
    append_float_row(tile.data(), tile.size(), m_options.bits, data);
    for (std::size_t y = 0; y < std::size_t(m_height); ++y)
        predict_float_row(reinterpret_cast<unsigned char*>(data.data()) + y * row_samples * bytes, row_samples, bytes,
                          std::size_t(planes));
    return deflated(data);
}

void ImageBlocks::write(ByteSink& file) const
{
    for (const std::string& block : m_compressed) {
        file.write(block);
        file.write("\0", padded(std::uint32_t(block.size())) - block.size());
    }
    std::string strip;
    const std::size_t row_samples = std::size_t(m_image.width) * std::size_t(m_image.planes);
    for (int y = 0; m_compressed.empty() && file.good() && y < m_image.height; ++y) {
        const std::ptrdiff_t at = y * m_image.row_stride;
        if (m_image.shorts)
            append_packed_row(m_image.shorts + at, row_samples, m_options.bits, strip);
        else
            append_float_row(m_image.floats + at, row_samples, m_options.bits, strip);
        if (strip.size() >= kStripBytes || y + 1 == m_image.height) {
            file.write(strip);
            strip.clear();
        }
    }
}

} // namespace srisp
