// SPDX-License-Identifier: Apache-2.0
#include "picture.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include <OpenImageIO/imagebufalgo.h>

#include "photo/photo_converter.h"
#include "require.h"

using namespace srisp;

Picture load_photo(const std::string& path)
{
    OIIO::ImageBuf file(path);
    if (!file.read(0, 0, true, OIIO::TypeFloat))
        throw std::runtime_error(path + ": " + file.geterror());
    file = OIIO::ImageBufAlgo::reorient(file);
    const PhotoConverter converter = require(PhotoConverter::create(file.spec(), InputEncoding::automatic, path));
    Picture photo(file.spec().width, file.spec().height);
    std::vector<float> stored(std::size_t(photo.width) * photo.height * file.nchannels());
    file.get_pixels(OIIO::ROI(), OIIO::TypeFloat, stored.data());
    PhotoCounts counts;
    converter.to_rgb(stored.data(), std::int64_t(photo.width) * photo.height, photo.rgb.data(), counts);
    return photo;
}

Sheet::Sheet(int columns, int rows, int cell_px)
    : m_image(OIIO::ImageSpec(columns * cell_px, rows * cell_px, 3, OIIO::TypeFloat)), m_cell_px(cell_px)
{
    OIIO::ImageBufAlgo::fill(m_image, { 0.25f, 0.25f, 0.25f });
}

void Sheet::paste(const Picture& picture, float exponent, int column, int row)
{
    constexpr int margin_px = 4;
    OIIO::ImageBuf buffer(OIIO::ImageSpec(picture.width, picture.height, 3, OIIO::TypeFloat),
                          const_cast<float*>(picture.rgb.data()));
    const OIIO::ImageBuf encoded = OIIO::ImageBufAlgo::pow(buffer, exponent);
    const double scale = double(m_cell_px - margin_px) / std::max(picture.width, picture.height);
    const int width = std::max(1, int(picture.width * scale)), height = std::max(1, int(picture.height * scale));
    const OIIO::ImageBuf small =
        OIIO::ImageBufAlgo::resize(encoded, "triangle", 0.0f, OIIO::ROI(0, width, 0, height, 0, 1, 0, 3));
    OIIO::ImageBufAlgo::paste(m_image, column * m_cell_px + (m_cell_px - width) / 2,
                              row * m_cell_px + (m_cell_px - height) / 2, 0, 0, small);
}

void Sheet::write(const std::string& path) const
{
    const std::string temporary = path + ".part" + std::filesystem::path(path).extension().string();
    if (!m_image.write(temporary, OIIO::TypeUInt8)) {
        std::filesystem::remove(temporary);
        throw std::runtime_error(path + ": " + m_image.geterror());
    }
    std::filesystem::rename(temporary, path);
}
