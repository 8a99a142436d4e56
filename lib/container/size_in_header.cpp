// SPDX-License-Identifier: Apache-2.0
#include "container/size_in_header.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include <libheif/heif.h>

#include "base/file_bytes.h"
#include "container/exr_header.h"
#include "container/image_limits.h"
#include "container/image_memory.h"
#include "jpeg/jpeg_segments.h"

namespace srisp {

namespace {

constexpr std::size_t kHeadBytes = 512;
constexpr std::size_t kLargestFile = std::size_t(4) << 30;

struct HeaderSize {
    std::uint64_t width, height;
    int channels = 3;
    bool held = true; ///< as a whole by the reader
};

std::uint64_t number(std::string_view bytes, std::size_t at, int count, bool big_endian)
{
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i) {
        const std::size_t place = at + std::size_t(big_endian ? i : count - 1 - i);
        value = value << 8 | static_cast<unsigned char>(bytes[place]);
    }
    return value;
}

std::optional<HeaderSize> gif_size(std::string_view head)
{
    if (head.size() < 10)
        return {};
    return HeaderSize{ number(head, 6, 2, false), number(head, 8, 2, false), 4 };
}

/// Runs are decoded when a file is opened.
std::optional<HeaderSize> bmp_size(std::string_view head)
{
    constexpr std::uint64_t kRuns8 = 1, kRuns4 = 2;
    if (head.size() < 34 || number(head, 14, 4, false) < 40)
        return {};
    const auto width = std::int32_t(number(head, 18, 4, false)), height = std::int32_t(number(head, 22, 4, false));
    const std::uint64_t compression = number(head, 30, 4, false);
    if (compression != kRuns8 && compression != kRuns4)
        return {};
    return HeaderSize{ std::uint64_t(std::abs(std::int64_t(width))), std::uint64_t(std::abs(std::int64_t(height))) };
}

std::optional<HeaderSize> png_size(std::string_view head)
{
    constexpr int kChannels[] = { 1, 1, 3, 3, 2, 2, 4, 4 }; // palette and colour, alpha, both
    if (head.size() < 29 || head[28] == 0)                  // not interlaced: read by rows
        return {};
    return HeaderSize{ number(head, 16, 4, true), number(head, 20, 4, true), kChannels[head[25] & 7] };
}

/// The codestream's own size (the marker SIZ); else the box that repeats it.
std::optional<HeaderSize> jpeg2000_size(std::string_view head)
{
    using namespace std::string_view_literals;
    constexpr std::string_view kStart = "\xff\x4f\xff\x51"sv;
    if (const std::size_t at = head.find(kStart); at != head.npos && at + 42 <= head.size()) {
        const std::uint64_t right = number(head, at + 8, 4, true), bottom = number(head, at + 12, 4, true);
        const std::uint64_t left = number(head, at + 16, 4, true), top = number(head, at + 20, 4, true);
        if (left < right && top < bottom)
            return HeaderSize{ right - left, bottom - top, int(number(head, at + 40, 2, true)) };
    }
    if (const std::size_t at = head.find("ihdr"); at != head.npos && at + 14 <= head.size())
        return HeaderSize{ number(head, at + 8, 4, true), number(head, at + 4, 4, true),
                           int(number(head, at + 12, 2, true)) };
    return {};
}

std::optional<HeaderSize> heif_size(const std::string& path)
{
    const std::unique_ptr<heif_context, decltype(&heif_context_free)> context(heif_context_alloc(), heif_context_free);
    if (heif_context_read_from_file(context.get(), path.c_str(), nullptr).code != heif_error_Ok)
        return {};
    heif_image_handle* found = nullptr;
    if (heif_context_get_primary_image_handle(context.get(), &found).code != heif_error_Ok)
        return {};
    const std::unique_ptr<heif_image_handle, decltype(&heif_image_handle_release)> handle(found,
                                                                                          heif_image_handle_release);
    return HeaderSize{ std::uint64_t(heif_image_handle_get_width(found)),
                       std::uint64_t(heif_image_handle_get_height(found)), 4 };
}

/// What the first bytes of a file say.
struct SizeOf {
    const char* reader;
    std::optional<HeaderSize> (*size)(std::string_view head);
};
constexpr SizeOf kSizes[] = {
    { "bmp", bmp_size }, { "gif", gif_size }, { "jpeg2000", jpeg2000_size }, { "png", png_size }
};

Status check(const std::string& reader, const HeaderSize& size, std::uint64_t file_bytes)
{
    if (size.width == 0 || size.height == 0) // its reader has words of its own
        return {};
    if (Status claim = check_claim(reader.c_str(), size.width, size.height, file_bytes); !claim)
        return claim;
    if (Status sides = check_sides(size.width, size.height); !sides || !size.held)
        return sides;
    return check_memory(size.width * size.height, std::max(size.channels, 1));
}

/// Photos have some ten scans. Empty ones are a few bytes each, and cost as much as full ones.
Status check_scans(const JpegFrame& frame)
{
    constexpr std::uint64_t kUsualScans = 64, kMostPixelPasses = std::uint64_t(1) << 30;
    const std::uint64_t pixels = std::uint64_t(frame.width) * std::uint64_t(frame.height);
    if (frame.scans <= kUsualScans || pixels * frame.scans <= kMostPixelPasses)
        return {};
    return Error{ "has " + std::to_string(frame.scans) + " scans, each of all its " + std::to_string(frame.width) +
                  " x " + std::to_string(frame.height) + " pixels; the limit is " + std::to_string(kUsualScans) };
}

Status check_jpeg(const std::string& path)
{
    const auto file = read_head(path, kLargestFile);
    if (!file)
        return file.error();
    const auto frame = find_jpeg_frame(*file);
    if (!frame)
        return {};
    // Entropy coding by arithmetic needs next to no bits for what is as expected.
    if (const Status size = check(frame->arithmetic ? "" : "jpeg",
                                  { std::uint64_t(frame->width), std::uint64_t(frame->height), frame->channels,
                                    frame->progressive || frame->scans > 1 },
                                  file->size());
        !size)
        return size;
    return check_scans(*frame);
}

/// OpenImageIO takes as much memory as a DPX says that it has of the user's data.
Status check_dpx(const std::string& path)
{
    constexpr std::size_t kUserSizeAt = 32;
    constexpr std::uint64_t kUndefined = 0xffffffff;
    const auto head = read_head(path, kHeadBytes);
    if (!head)
        return head.error();
    if (head->size() < kUserSizeAt + 4)
        return {};
    const std::uint64_t size = number(*head, kUserSizeAt, 4, (*head)[0] == 'S');
    std::error_code ignored;
    const std::uintmax_t bytes = std::filesystem::file_size(path, ignored);
    if (size == kUndefined || size <= bytes)
        return {};
    return Error{ "is damaged or truncated: is to have " + std::to_string(size) + " bytes of user data, the file has " +
                  std::to_string(bytes) };
}

} // namespace

Status check_header(const std::string& reader, const std::string& path)
{
    if (reader == "jpeg")
        return check_jpeg(path);
    if (reader == "dpx")
        return check_dpx(path);
    if (reader == "openexr")
        return check_exr_header(path);
    std::optional<HeaderSize> size;
    if (reader == "heif") {
        size = heif_size(path);
    } else if (const auto found = std::find_if(std::begin(kSizes), std::end(kSizes),
                                               [&](const SizeOf& known) { return reader == known.reader; });
               found != std::end(kSizes)) {
        const auto head = read_head(path, kHeadBytes);
        if (!head)
            return head.error();
        size = found->size(*head);
    }
    std::error_code ignored;
    return size ? check(reader, *size, std::filesystem::file_size(path, ignored)) : Status();
}

} // namespace srisp
