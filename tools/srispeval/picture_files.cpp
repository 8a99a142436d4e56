// SPDX-License-Identifier: Apache-2.0
#include "picture_files.h"

#include <algorithm>
#include <cmath>

#include <OpenImageIO/imageio.h>
#include <srisp/srisp.h>

namespace srisp::tool {

namespace {

constexpr int kSignificantBits = 9;

Expected<std::string> encoded(OIIO::ImageSpec spec, std::vector<float> values, const std::string& name,
                              const std::string& compression)
{
    const auto bytes = Image(std::move(spec), std::move(values)).encode(name, OIIO::TypeUInt8, compression);
    if (!bytes)
        return bytes.error();
    return std::string(bytes->begin(), bytes->end());
}

std::uint32_t sixteen_bits(float value)
{
    auto code = std::uint32_t(std::lround(std::clamp(value, 0.0f, 1.0f) * 65535));
    int bits = 0;
    while ((code >> bits) > 0)
        ++bits;
    const int dropped = std::max(bits - kSignificantBits, 0);
    if (dropped > 0)
        code = std::min<std::uint32_t>(((code + (1u << (dropped - 1))) >> dropped) << dropped, 65535);
    return code;
}

} // namespace

Expected<std::string> jpeg_of_photo(const Pixels& photo)
{
    OIIO::ImageSpec spec(photo.width, photo.height, 3, OIIO::TypeFloat);
    spec.attribute("oiio:ColorSpace", "sRGB");
    return encoded(spec, photo.rgb, "photo.jpg", "jpeg:90");
}

Expected<std::string> png_of_linear(const Pixels& pixels)
{
    std::vector<float> values(pixels.rgb.size() * 2);
    for (std::size_t i = 0; i < pixels.rgb.size(); ++i) {
        const std::uint32_t code = sixteen_bits(pixels.rgb[i]);
        values[i] = float(code >> 8) / 255;
        values[pixels.rgb.size() + i] = float(code & 255) / 255;
    }
    return encoded(OIIO::ImageSpec(pixels.width, 2 * pixels.height, 3, OIIO::TypeFloat), std::move(values),
                   "picture.png", "");
}

} // namespace srisp::tool
