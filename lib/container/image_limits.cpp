// SPDX-License-Identifier: Apache-2.0
#include "container/image_limits.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>

#include "base/parsed_number.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

constexpr std::uint64_t kMillion = 1'000'000, kMostMegapixels = 2000;
constexpr std::int64_t kFarthest = 1 << 30;                    // of an edge from the origin
constexpr std::int64_t kMostRowValues = std::int64_t(1) << 24; // 64 MB as float; some rows are read at a time
constexpr std::int64_t kMostTileValues = std::int64_t(1) << 26;

/// Claims up to this are not asked: decoding takes a moment, and what is missing is told then, row by row.
constexpr std::uint64_t kSmallImage = 16 * kMillion;

/// What the best compressed file of each format comes to, with room to spare.
struct Densest {
    const char* reader;
    std::uint64_t pixels_per_byte;
};
constexpr Densest kDensest[] = {
    { "bmp", 1 << 20 },  // runs may end early, and leave the rest black
    { "cineon", 1 },     // nothing is compressed; ten bits and more
    { "dds", 2 },        // blocks of 4 x 4 pixels in 8 bytes
    { "dpx", 16 },       // one bit, and runs
    { "jpeg", 512 },     // one bit for each 8 x 8 pixels of one channel
    { "pnm", 8 },        // one bit
    { "png", 8 * 1032 }, // one bit, and 1032 is all that deflate can do
    { "psd", 8 * 128 },  // one bit, and runs of 128
    { "targa", 128 },    // runs of 128
    // Lossless WebP needs no bytes at all for one colour, whatever the size (which its format limits).
    { "webp", UINT64_MAX },
};
constexpr std::uint64_t kDensestOfOthers = 1 << 20;

std::string size_text(std::int64_t width, std::int64_t height)
{
    return std::to_string(width) + " x " + std::to_string(height);
}

Error limit_error(const std::string& what, std::int64_t value, const std::string& limit)
{
    return Error{ "has " + what + " " + std::to_string(value) + "; " + limit };
}

Status check_windows(const OIIO::ImageSpec& spec)
{
    struct Edge {
        const char* name;
        std::int64_t value, least;
    };
    const Edge edges[] = {
        { "a data window whose left edge is at", spec.x, -kFarthest },
        { "a data window whose upper edge is at", spec.y, -kFarthest },
        { "a data window whose front is at", spec.z, -kFarthest },
        { "a display window whose left edge is at", spec.full_x, -kFarthest },
        { "a display window whose upper edge is at", spec.full_y, -kFarthest },
        { "a display window of the width", spec.full_width, 0 },
        { "a display window of the height", spec.full_height, 0 },
    };
    for (const Edge& edge : edges)
        if (edge.value < edge.least || edge.value > kFarthest)
            return limit_error(edge.name, edge.value,
                               "from " + std::to_string(edge.least) + " to " + std::to_string(kFarthest) +
                                   " is possible");
    return {};
}

Status check_tiles(const OIIO::ImageSpec& spec)
{
    if (spec.tile_width == 0)
        return {};
    const int smallest = std::min({ spec.tile_width, spec.tile_height, spec.tile_depth });
    const int largest = std::max({ spec.tile_width, spec.tile_height, spec.tile_depth });
    if (smallest < 1 || largest > kLargestSide)
        return Error{ "has tiles of " + size_text(spec.tile_width, spec.tile_height) + " x " +
                      std::to_string(spec.tile_depth) + " pixels; from 1 to " + std::to_string(kLargestSide) +
                      " a side are possible" };
    // Tiles reach beyond small images, but not without end. Three factors of 2^20 and 2^10 channels: in steps.
    const std::int64_t row = std::int64_t(spec.tile_width) * spec.nchannels;
    const std::int64_t plane = row * spec.tile_height;
    const std::int64_t image = std::int64_t(spec.image_pixels()) * spec.nchannels;
    const std::int64_t most = std::max(kMostTileValues, 4 * image);
    if (plane > most || plane * spec.tile_depth > most)
        return Error{ "has tiles of " + size_text(spec.tile_width, spec.tile_height) + " pixels of " +
                      std::to_string(spec.nchannels) + " channels, which is more than the limit of " +
                      std::to_string(most) + " values" };
    return {};
}

/// In millions.
Expected<std::uint64_t> most_megapixels()
{
    const char* const text = std::getenv("SRISP_MAX_MEGAPIXELS");
    if (!text || !*text)
        return kMostMegapixels;
    const auto number = parsed_number<std::uint64_t>(text);
    if (!number || *number < 1 || *number > kMillion)
        return Error{ "cannot be read: SRISP_MAX_MEGAPIXELS in the environment is '" + shown_text(text) +
                      "'; a whole number from 1 to 1000000 is possible" };
    return *number;
}

} // namespace

Status check_sides(std::uint64_t width, std::uint64_t height)
{
    const std::string size = "has " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
    if (std::min(width, height) < 1 || std::max(width, height) > kLargestSide)
        return Error{ size + "; from 1 to " + std::to_string(kLargestSide) + " a side are possible" };
    const auto most = most_megapixels();
    if (!most)
        return most.error();
    if (width * height > *most * kMillion)
        return Error{ size + ", which is more than the limit of " + std::to_string(*most) +
                      " million; SRISP_MAX_MEGAPIXELS in the environment sets another" };
    return {};
}

Status check_size(const OIIO::ImageSpec& spec)
{
    if (std::min(spec.width, spec.height) < 1)
        return Error{ "has " + size_text(spec.width, spec.height) + " pixels; from 1 to " +
                      std::to_string(kLargestSide) + " a side are possible" };
    if (Status sides = check_sides(std::uint64_t(spec.width), std::uint64_t(spec.height)); !sides)
        return sides;
    if (spec.depth < 1)
        return Error{ "has a depth of " + std::to_string(spec.depth) + " planes; 1 and more are possible" };
    const std::uint64_t plane = std::uint64_t(spec.width) * std::uint64_t(spec.height);
    if (const auto most = most_megapixels(); most && std::uint64_t(spec.depth) > *most * kMillion / plane)
        return Error{ "is a volume of " + size_text(spec.width, spec.height) + " x " + std::to_string(spec.depth) +
                      " pixels, which is more than the limit of " + std::to_string(*most) + " million" };
    if (spec.nchannels < 1 || spec.nchannels > kMostChannels)
        return limit_error("a number of channels of", spec.nchannels,
                           "from 1 to " + std::to_string(kMostChannels) + " are possible");
    if (std::int64_t(spec.width) * spec.nchannels > kMostRowValues)
        return Error{ "has rows of " + std::to_string(spec.width) + " pixels of " + std::to_string(spec.nchannels) +
                      " channels, which is more than the limit of " + std::to_string(kMostRowValues) + " values" };
    // The greatest number stands for all rows. By others OpenImageIO's reader takes memory, and goes astray.
    const int strip = spec.get_int_attribute("tiff:RowsPerStrip", 1);
    if (strip > kLargestSide || strip < -1)
        return Error{ "has strips of " + std::to_string(std::uint32_t(strip)) + " rows; the limit is " +
                      std::to_string(kLargestSide) };
    if (Status windows = check_windows(spec); !windows)
        return windows;
    return check_tiles(spec);
}

Status check_claim(const char* reader, std::uint64_t width, std::uint64_t height, std::uint64_t file_bytes)
{
    const auto found = std::find_if(std::begin(kDensest), std::end(kDensest),
                                    [&](const Densest& known) { return std::strcmp(known.reader, reader) == 0; });
    const std::uint64_t densest = found == std::end(kDensest) ? kDensestOfOthers : found->pixels_per_byte;
    const std::uint64_t pixels = width * height;
    if (pixels <= kSmallImage || pixels / densest <= file_bytes)
        return {};
    return Error{ "is damaged or truncated: says that it has " + size_text(std::int64_t(width), std::int64_t(height)) +
                  " pixels, but has only " + std::to_string(file_bytes) + " bytes; its format holds at most " +
                  std::to_string(densest) + " pixels in a byte" };
}

void limit_strips(OIIO::ImageSpec& spec)
{
    const char kRows[] = "tiff:RowsPerStrip";
    const int rows = spec.get_int_attribute(kRows, 1);
    if (rows < 1 || rows > spec.height)
        spec.attribute(kRows, spec.height);
}

std::int64_t rows_of_part(std::int64_t most_pixels, const OIIO::ImageSpec& spec, int parts)
{
    constexpr std::int64_t kLeastPixels = 1 << 14;
    const std::int64_t width = std::max(spec.width, 1), rows = (std::int64_t(spec.height) + parts - 1) / parts;
    return std::max<std::int64_t>(std::min(most_pixels / width, std::max(rows, kLeastPixels / width)), 1);
}

int rows_in_tiles(std::int64_t wanted, const OIIO::ImageSpec& spec)
{
    const std::int64_t tile = std::max(spec.tile_height, 1);
    const std::int64_t rows = (wanted + tile - 1) / tile * tile;
    return static_cast<int>(std::min<std::int64_t>(rows, std::max(spec.height, 1)));
}

} // namespace srisp
