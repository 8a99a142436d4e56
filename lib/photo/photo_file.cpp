// SPDX-License-Identifier: Apache-2.0
#include "photo/photo_file.h"

#include <algorithm>
#include <filesystem>

#include "photo/image_rows.h"

namespace srisp {

namespace {

constexpr int kBandPixels = 1 << 18; // 3 MB of RGB
constexpr int kLargestSide = 1 << 17;

} // namespace

Expected<PhotoFile> PhotoFile::open(const std::string& path)
{
    const std::string where = "photo '" + path + "'";
    std::error_code ignored;
    // Before OpenImageIO sees the name: it would offer it to every plugin.
    if (!std::filesystem::is_regular_file(path, ignored))
        return Error{ where + (std::filesystem::exists(path, ignored) ? ": is no regular file" : ": does not exist") };
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1); // so that nothing is lost in dark transparent pixels
    auto input = OIIO::ImageInput::open(path, &hints);
    if (!input) {
        const std::string reason = OIIO::geterror();
        return Error{ where + ": " + (reason.empty() ? "is no image that OpenImageIO reads" : reason) };
    }
    input->threads(1);
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || std::max(spec.width, spec.height) > kLargestSide)
        return Error{ where + ": has " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                      " pixels; from 1 to " + std::to_string(kLargestSide) + " a side are possible" };
    auto converter = PhotoConverter::create(spec, InputEncoding::automatic, where);
    if (!converter)
        return converter.error();
    return PhotoFile(where, std::move(input), std::move(*converter));
}

PhotoFile::PhotoFile(std::string where, std::unique_ptr<OIIO::ImageInput> input, PhotoConverter converter)
    : m_where(std::move(where)), m_input(std::move(input)), m_converter(std::move(converter))
{
    const OIIO::ImageSpec& spec = m_input->spec();
    m_width = spec.width;
    m_height = spec.height;
    m_channels = spec.nchannels;
    m_orientation = spec.get_int_attribute("Orientation", 1);
    const int tile = std::max(spec.tile_height, 1);
    m_band_rows = (std::max(kBandPixels / m_width, 1) + tile - 1) / tile * tile;
}

Expected<const float*> PhotoFile::read(int y0, int y1)
{
    const std::size_t pixels = std::size_t(m_width) * (y1 - y0);
    m_stored.resize(pixels * m_channels);
    m_rgb.resize(pixels * 3);
    // Truncated JPEGs are read to the end, grey from where they break off; the reader's warning is all that tells.
    if (!read_image_rows(*m_input, 0, 0, y0, y1, m_stored.data()) || m_input->has_error()) {
        const std::string reason = m_input->geterror();
        return Error{ m_where + ": damaged or truncated at row " + std::to_string(y0) +
                      (reason.empty() ? "" : ": " + reason) };
    }
    m_converter.to_rgb(m_stored.data(), std::int64_t(pixels), m_rgb.data(), m_counts);
    return m_rgb.data();
}

} // namespace srisp
