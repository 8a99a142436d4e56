// SPDX-License-Identifier: Apache-2.0
#include "recipe/photo_size.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/hashes.h"
#include "base/parsed_number.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

constexpr int kLargestSide = 65535;
const std::string kRandom = "random:";

std::optional<int> whole_number(const std::string& text)
{
    const auto number = parsed_number<int>(text);
    return number && *number >= 0 && *number <= kLargestSide ? number : std::nullopt;
}

/// From "640x480".
std::optional<PhotoSize> pair_of_sides(const std::string& text)
{
    const std::size_t x = text.find('x');
    if (x == std::string::npos)
        return {};
    const auto width = whole_number(text.substr(0, x)), height = whole_number(text.substr(x + 1));
    return width && height ? std::optional(PhotoSize{ *width, *height }) : std::nullopt;
}

std::optional<double> percent(const std::string& text)
{
    if (text.empty() || text.back() != '%')
        return {};
    const auto number = parsed_number<double>(std::string_view(text).substr(0, text.size() - 1));
    return number && *number > 0 && *number <= 1000 ? number : std::nullopt;
}

bool is_random(const std::string& crop)
{
    return crop.compare(0, kRandom.size(), kRandom) == 0;
}

std::optional<PhotoSize> crop_size(const std::string& crop)
{
    const std::string text = is_random(crop) ? crop.substr(kRandom.size()) : crop;
    const auto side = whole_number(text);
    const auto size = side ? std::optional(PhotoSize{ *side, *side }) : pair_of_sides(text);
    return size && size->width > 0 && size->height > 0 ? size : std::nullopt;
}

int side(double pixels)
{
    return std::clamp(int(std::lround(pixels)), 1, kLargestSide);
}

} // namespace

Status check_resize(const std::string& text)
{
    const auto shorter = whole_number(text);
    const auto size = pair_of_sides(text);
    if (text.empty() || (shorter && *shorter > 0) || (size && (size->width || size->height)) || percent(text))
        return {};
    return Error{ "resize '" + shown_text(text) + "' is not N (the shorter side), WxH, Wx0, 0xH or P%, up to 65535" };
}

Status check_crop(const std::string& text)
{
    if (text.empty() || crop_size(text))
        return {};
    return Error{ "crop '" + shown_text(text) + "' is not N, WxH, random:N or random:WxH, up to 65535" };
}

PhotoSize resized(const std::string& resize, PhotoSize photo)
{
    const double width = photo.width, height = photo.height;
    if (const auto size = pair_of_sides(resize)) {
        if (size->width && size->height)
            return *size;
        return size->width ? PhotoSize{ size->width, side(height * size->width / width) }
                           : PhotoSize{ side(width * size->height / height), size->height };
    }
    const auto part = percent(resize);
    const double scale = part ? *part / 100 : whole_number(resize).value_or(1) / std::min(width, height);
    return { side(width * scale), side(height * scale) };
}

Expected<PhotoPart> cropped(const std::string& crop, PhotoSize photo, std::uint64_t seed)
{
    const auto size = crop_size(crop);
    if (!size || size->width > photo.width || size->height > photo.height)
        return Error{ "crop '" + shown_text(crop) + "': the photo has only " + std::to_string(photo.width) + " x " +
                      std::to_string(photo.height) + " pixels" };
    const int left = photo.width - size->width, above = photo.height - size->height;
    PhotoPart part{ left / 2, above / 2, size->width, size->height };
    if (is_random(crop)) {
        part.x = int(seeded_hash(seed, "crop x") % std::uint64_t(left + 1));
        part.y = int(seeded_hash(seed, "crop y") % std::uint64_t(above + 1));
    }
    return part;
}

} // namespace srisp
