// SPDX-License-Identifier: Apache-2.0
#include "jpeg/jpeg_segments.h"

#include <algorithm>
#include <cstdint>

namespace srisp {

namespace {

constexpr int kStartOfImage = 0xd8, kEndOfImage = 0xd9, kStartOfScan = 0xda, kApp0 = 0xe0;
constexpr std::size_t kMostImages = 16;

bool starts_with(std::string_view text, std::string_view start)
{
    return text.substr(0, start.size()) == start;
}

int byte_at(std::string_view bytes, std::size_t at)
{
    return static_cast<unsigned char>(bytes[at]);
}

/// Walks from one marker of a JPEG to the next. Scans are passed over.
class MarkerWalk {
public:
    /// `lenient`: passes over stray bytes before a marker; otherwise they end the walk.
    explicit MarkerWalk(std::string_view jpeg, bool lenient = false) : m_jpeg(jpeg), m_lenient(lenient) {}

    /// Goes to the next marker; false where there is none, or a segment is cut.
    bool next()
    {
        if (m_code == kStartOfScan)
            pass_scan();
        if (m_lenient)
            pass_strays();
        while (m_end + 1 < m_jpeg.size() && byte_at(m_jpeg, m_end) == 0xff && byte_at(m_jpeg, m_end + 1) == 0xff)
            ++m_end; // fill bytes
        if (m_end + 1 >= m_jpeg.size() || byte_at(m_jpeg, m_end) != 0xff)
            return false;
        m_code = byte_at(m_jpeg, m_end + 1);
        m_end += 2;
        m_content = {};
        if (stands_alone(m_code))
            return true;
        if (m_jpeg.size() - m_end < 2)
            return false;
        const std::size_t size = std::size_t(byte_at(m_jpeg, m_end)) << 8 | std::size_t(byte_at(m_jpeg, m_end + 1));
        if (size < 2 || m_jpeg.size() - m_end < size)
            return false;
        m_content = m_jpeg.substr(m_end + 2, size - 2);
        m_end += size;
        return true;
    }

    int code() const { return m_code; }
    std::string_view content() const { return m_content; }
    /// The bytes up to the marker's end.
    std::size_t end() const { return m_end; }

private:
    static bool is_restart(int code) { return code >= 0xd0 && code <= 0xd7; }
    static bool stands_alone(int code)
    {
        return is_restart(code) || code == kStartOfImage || code == kEndOfImage || code == 0x01;
    }
    void pass_strays()
    {
        while (m_end + 1 < m_jpeg.size() && (byte_at(m_jpeg, m_end) != 0xff || byte_at(m_jpeg, m_end + 1) == 0))
            ++m_end;
    }
    /// To the first 0xff that neither a stuffed zero nor a restart follows.
    void pass_scan()
    {
        while ((m_end = m_jpeg.find('\xff', m_end)) != std::string_view::npos && m_end + 1 < m_jpeg.size()) {
            const int code = byte_at(m_jpeg, m_end + 1);
            if (code != 0 && !is_restart(code))
                return;
            m_end += 2;
        }
        m_end = m_jpeg.size();
    }

    std::string_view m_jpeg, m_content;
    std::size_t m_end = 0;
    int m_code = 0;
    bool m_lenient;
};

bool is_jpeg(std::string_view bytes)
{
    return starts_with(bytes, "\xff\xd8\xff");
}

/// Numbers of a TIFF structure of either byte order.
class TiffNumbers {
public:
    explicit TiffNumbers(std::string_view bytes) : m_bytes(bytes), m_big(starts_with(bytes, "MM")) {}

    bool is_tiff() const { return (m_big || starts_with(m_bytes, "II")) && number(2, 2) == 42; }
    std::size_t size() const { return m_bytes.size(); }
    /// Of `bytes` bytes; 0 beyond the end.
    std::uint32_t number(std::uint64_t at, int bytes) const
    {
        if (at + bytes > m_bytes.size())
            return 0;
        std::uint32_t value = 0;
        for (int i = 0; i < bytes; ++i)
            value = value << 8 | std::uint32_t(byte_at(m_bytes, at + (m_big ? i : bytes - 1 - i)));
        return value;
    }

private:
    std::string_view m_bytes;
    bool m_big;
};

/// Where the entries of a multi-picture index are in it, and how many.
struct EntryList {
    std::uint64_t at = 0, count = 0;
};

constexpr std::uint64_t kEntryBytes = 16;

EntryList find_entries(const TiffNumbers& index)
{
    constexpr std::uint32_t kEntriesTag = 0xb002;
    const std::uint64_t directory = index.number(4, 4);
    const std::uint32_t tags = index.number(directory, 2);
    for (std::uint32_t i = 0; i < tags; ++i) {
        const std::uint64_t tag = directory + 2 + 12 * std::uint64_t(i);
        if (tag + 12 > index.size())
            break;
        if (index.number(tag, 2) == kEntriesTag)
            return { index.number(tag + 8, 4), index.number(tag + 4, 4) / kEntryBytes };
    }
    return {};
}

} // namespace

std::optional<std::string_view> find_app_segment(std::string_view jpeg, int n, std::string_view signature)
{
    MarkerWalk walk(jpeg);
    if (!walk.next() || walk.code() != kStartOfImage)
        return {};
    while (walk.next() && walk.code() != kStartOfScan && walk.code() != kEndOfImage)
        if (walk.code() == kApp0 + n && starts_with(walk.content(), signature))
            return walk.content().substr(signature.size());
    return {};
}

std::optional<JpegFrame> find_jpeg_frame(std::string_view jpeg)
{
    constexpr bool kLenient = true;
    MarkerWalk walk(jpeg, kLenient);
    if (!walk.next() || walk.code() != kStartOfImage)
        return {};
    std::optional<JpegFrame> frame;
    while (walk.next() && walk.code() != kEndOfImage) {
        const int code = walk.code();
        // SOF0 … SOF15 are all of this row but for DHT, JPG and DAC.
        const bool starts_frame = code >= 0xc0 && code <= 0xcf && code != 0xc4 && code != 0xc8 && code != 0xcc;
        if (starts_frame && !frame && walk.content().size() >= 6) {
            const auto side = [&](std::size_t at) {
                return byte_at(walk.content(), at) << 8 | byte_at(walk.content(), at + 1);
            };
            frame = JpegFrame{ side(3), side(1), byte_at(walk.content(), 5), code > 0xc8, (code & 3) == 2, 0 };
        }
        if (code == kStartOfScan && frame)
            ++frame->scans;
    }
    return frame;
}

std::optional<std::string_view> find_xmp_packet(std::string_view jpeg)
{
    using namespace std::string_view_literals;
    return find_app_segment(jpeg, 1, "http://ns.adobe.com/xap/1.0/\0"sv);
}

std::optional<std::size_t> jpeg_image_size(std::string_view jpeg)
{
    MarkerWalk walk(jpeg);
    if (!walk.next() || walk.code() != kStartOfImage)
        return {};
    while (walk.next())
        if (walk.code() == kEndOfImage)
            return walk.end();
    return {};
}

std::vector<std::string_view> find_further_images(std::string_view file)
{
    using namespace std::string_view_literals;
    const auto segment = find_app_segment(file, 2, "MPF\0"sv);
    if (!segment)
        return {};
    const TiffNumbers index(*segment);
    if (!index.is_tiff())
        return {};
    const EntryList entries = find_entries(index);
    // Offsets count from the index's byte-order mark.
    const std::uint64_t origin = std::uint64_t(segment->data() - file.data());
    std::vector<std::string_view> images;
    for (std::uint64_t i = 1; i < std::min<std::uint64_t>(entries.count, 1 + kMostImages); ++i) {
        const std::uint64_t entry = entries.at + i * kEntryBytes;
        const std::uint64_t size = index.number(entry + 4, 4), start = origin + index.number(entry + 8, 4);
        if (start <= file.size() && size <= file.size() - start && is_jpeg(file.substr(start, size)))
            images.push_back(file.substr(start, size));
    }
    return images;
}

} // namespace srisp
