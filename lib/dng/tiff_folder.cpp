// SPDX-License-Identifier: Apache-2.0
#include "dng/tiff_folder.h"

#include <cmath>
#include <cstring>

namespace srisp {

namespace {

constexpr std::size_t kEntryBytes = 12, kInlineBytes = 4;

void put_integer(std::string& text, std::uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; ++i)
        text += char(value >> 8 * i & 255);
}

/// Of values beside the entries.
std::size_t padded(std::size_t bytes)
{
    return bytes <= kInlineBytes ? 0 : bytes + bytes % 2;
}

} // namespace

std::pair<std::int32_t, std::int32_t> fraction_of(float value)
{
    constexpr double kMost = 2147483647;
    const double target = std::min(double(std::abs(value)), kMost);
    const int sign = std::signbit(value) ? -1 : 1;
    // Convergents of the continued fraction.
    double rest = target, numerator = 1, denominator = 0, last_numerator = 0, last_denominator = 1;
    for (int step = 0; step < 64; ++step) {
        const double whole = std::floor(rest);
        const double next_numerator = whole * numerator + last_numerator;
        const double next_denominator = whole * denominator + last_denominator;
        if (next_numerator > kMost || next_denominator > kMost)
            break;
        last_numerator = std::exchange(numerator, next_numerator);
        last_denominator = std::exchange(denominator, next_denominator);
        if (float(numerator / denominator) == float(target) || rest == whole)
            break;
        rest = 1 / (rest - whole);
    }
    return { sign * std::int32_t(numerator), std::int32_t(denominator) };
}

void TiffFolderBytes::set(std::uint16_t tag, std::uint16_t type, std::size_t count, std::string values)
{
    m_entries[tag] = { type, std::uint32_t(count), std::move(values) };
}

void TiffFolderBytes::set_text(std::uint16_t tag, const std::string& text)
{
    const std::string values = std::string(text.c_str()) + '\0';
    set(tag, 2, values.size(), values);
}

void TiffFolderBytes::set_integers(std::uint16_t tag, std::uint16_t type, int bytes,
                                   const std::vector<std::uint32_t>& values)
{
    std::string text;
    for (const std::uint32_t value : values)
        put_integer(text, value, bytes);
    set(tag, type, values.size(), std::move(text));
}

void TiffFolderBytes::set_fractions(std::uint16_t tag, std::uint16_t type, const std::vector<float>& values)
{
    std::string text;
    for (const float value : values) {
        const auto [numerator, denominator] = fraction_of(value);
        put_integer(text, std::uint32_t(numerator), 4);
        put_integer(text, std::uint32_t(denominator), 4);
    }
    set(tag, type, values.size(), std::move(text));
}

void TiffFolderBytes::set_doubles(std::uint16_t tag, const std::vector<double>& values)
{
    std::string text;
    for (const double value : values) {
        std::uint64_t bits;
        std::memcpy(&bits, &value, 8);
        put_integer(text, bits, 8);
    }
    set(tag, 12, values.size(), std::move(text));
}

std::size_t TiffFolderBytes::size() const
{
    std::size_t bytes = 2 + kEntryBytes * m_entries.size() + 4;
    for (const auto& [tag, entry] : m_entries)
        bytes += padded(entry.values.size());
    return bytes;
}

std::string TiffFolderBytes::bytes(std::uint32_t offset) const
{
    std::string text, values;
    const std::size_t values_at = offset + 2 + kEntryBytes * m_entries.size() + 4;
    put_integer(text, m_entries.size(), 2);
    for (const auto& [tag, entry] : m_entries) {
        put_integer(text, tag, 2);
        put_integer(text, entry.type, 2);
        put_integer(text, entry.count, 4);
        if (entry.values.size() <= kInlineBytes) {
            text += entry.values;
            text.append(kInlineBytes - entry.values.size(), '\0');
        } else {
            put_integer(text, values_at + values.size(), 4);
            values += entry.values;
            values.append(entry.values.size() % 2, '\0');
        }
    }
    put_integer(text, 0, 4);
    return text + values;
}

std::string tiff_header()
{
    std::string text = "II*";
    text += '\0';
    put_integer(text, 8, 4);
    return text;
}

} // namespace srisp
