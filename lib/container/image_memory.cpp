// SPDX-License-Identifier: Apache-2.0
#include "container/image_memory.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string>

#include "base/machine_memory.h"
#include "base/printed.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

constexpr std::uint64_t kBytesPerValue = 8;

/// These decode as they are asked for rows. (Interlaced and progressive files are held as a whole: check_header.)
constexpr const char* kReadsRows[] = { "bmp", "cineon", "dpx", "fits", "hdr", "jpeg",      "openexr", "openvdb",
                                       "png", "pnm",    "psd", "rla",  "sgi", "softimage", "tiff" };

std::string in_gigabytes(std::uint64_t bytes)
{
    return printed("%.3g GB", double(bytes) / 1e9);
}

} // namespace

std::uint64_t image_memory(std::uint64_t pixels, int channels)
{
    return pixels * std::uint64_t(channels) * kBytesPerValue;
}

Expected<std::uint64_t> most_image_memory()
{
    const char* const text = std::getenv("SRISP_MAX_MEMORY");
    if (!text || !*text)
        return machine_memory();
    constexpr std::uint64_t kMostMegabytes = 1 << 30;
    std::uint64_t number = 0;
    const char* const end = text + std::strlen(text);
    auto [unit, failed] = std::from_chars(text, end, number);
    const bool gigabytes = unit != end && std::strcmp(unit, "G") == 0;
    const bool known = gigabytes || unit == end || std::strcmp(unit, "M") == 0;
    if (failed != std::errc() || !known || number < 1 || number > kMostMegabytes)
        return Error{ "cannot be read: SRISP_MAX_MEMORY in the environment is '" + shown_text(text) +
                      "'; a number of megabytes, or one with G behind it, is possible" };
    return number << (gigabytes ? 30 : 20);
}

Status check_memory(std::uint64_t pixels, int channels)
{
    const auto most = most_image_memory();
    if (!most)
        return most.error();
    const std::uint64_t bytes = image_memory(pixels, channels);
    if (bytes <= *most)
        return {};
    return Error{ "takes " + in_gigabytes(bytes) + " of memory, for " + std::to_string(pixels) + " pixels of " +
                  std::to_string(channels) + (channels == 1 ? " channel" : " channels") +
                  " at a time, which is more than the limit of " + in_gigabytes(*most) +
                  "; SRISP_MAX_MEMORY in the environment sets another" };
}

Status check_reading_memory(const char* reader, const OIIO::ImageSpec& spec)
{
    const bool rows = std::any_of(std::begin(kReadsRows), std::end(kReadsRows),
                                  [&](const char* name) { return std::strcmp(name, reader) == 0; });
    const std::uint64_t width = std::uint64_t(std::max(spec.width, spec.tile_width));
    if (!rows)
        return check_memory(width * std::uint64_t(spec.height), spec.nchannels);
    return check_memory(width * std::uint64_t(std::max(spec.tile_height, 1)), spec.nchannels);
}

} // namespace srisp
