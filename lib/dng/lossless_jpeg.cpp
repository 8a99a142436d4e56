// SPDX-License-Identifier: Apache-2.0
#include "dng/lossless_jpeg.h"

#include <cstddef>
#include <cstring>
#include <vector>

#include "dng/huffman_code.h"

namespace srisp {

namespace {

constexpr int kMostComponents = 4;

/// Of a difference modulo 2^16, taken as -32768 to 32767.
int category_of(std::int16_t difference)
{
    const int value = difference;
    const std::uint32_t magnitude = std::uint32_t(value < 0 ? -value : value);
    return magnitude == 0 ? 0 : 32 - __builtin_clz(magnitude);
}

/// Each sample less its left neighbour; the first of a row less the one above; the very first less half the range.
std::vector<std::int16_t> differences(const JpegSamples& samples)
{
    const std::size_t step = std::size_t(samples.components), row_values = std::size_t(samples.columns) * step;
    std::vector<std::int16_t> result(row_values * std::size_t(samples.rows));
    for (std::size_t y = 0; y < std::size_t(samples.rows); ++y) {
        const std::uint16_t* row = samples.values + y * row_values;
        std::int16_t* target = result.data() + y * row_values;
        for (std::size_t i = 0; i < step; ++i)
            target[i] =
                std::int16_t(std::uint16_t(row[i] - (y == 0 ? 1 << (samples.bits - 1) : *(row + i - row_values))));
        for (std::size_t i = step; i < row_values; ++i)
            target[i] = std::int16_t(std::uint16_t(row[i] - row[i - step]));
    }
    return result;
}

/// Bits, highest first, with a zero byte after each of all ones. `target` must have place for what is put.
class BitWriter {
public:
    explicit BitWriter(unsigned char* target) : m_target(target) {}

    /// At most 32 bits.
    void put(std::uint32_t value, int count)
    {
        m_bits = m_bits << count | value;
        m_count += count;
        if (m_count >= 32)
            flush_word();
    }
    /// Fills the last byte with ones; returns the end of what was written.
    unsigned char* finish()
    {
        if (m_count % 8 != 0) {
            const int fill = 8 - m_count % 8;
            m_bits = m_bits << fill | ((1u << fill) - 1);
            m_count += fill;
        }
        while (m_count > 0) {
            m_count -= 8;
            put_byte(static_cast<unsigned char>(m_bits >> m_count));
        }
        return m_target;
    }

private:
    void put_byte(unsigned char byte)
    {
        *m_target++ = byte;
        if (byte == 0xff)
            *m_target++ = 0;
    }
    void flush_word()
    {
        m_count -= 32;
        const auto word = std::uint32_t(m_bits >> m_count);
        if ((~word - 0x01010101u) & word & 0x80808080u) { // a byte of all ones
            for (int shift = 24; shift >= 0; shift -= 8)
                put_byte(static_cast<unsigned char>(word >> shift));
        } else {
            const std::uint32_t big_endian = __builtin_bswap32(word);
            std::memcpy(m_target, &big_endian, 4);
            m_target += 4;
        }
    }

    unsigned char* m_target;
    std::uint64_t m_bits = 0;
    int m_count = 0;
};

void put_short(std::string& text, int value)
{
    text += char(value >> 8);
    text += char(value & 255);
}

std::string header(const JpegSamples& samples, const HuffmanCode* codes)
{
    std::string text = "\xff\xd8\xff\xc3"; // start of image, of a lossless frame
    put_short(text, 8 + 3 * samples.components);
    text += char(samples.bits);
    put_short(text, samples.rows);
    put_short(text, samples.columns);
    text += char(samples.components);
    for (int c = 0; c < samples.components; ++c)
        text += { char(c), '\x11', '\0' }; // not subsampled, no quantisation
    for (int c = 0; c < samples.components; ++c) {
        text += "\xff\xc4";
        put_short(text, 19 + int(codes[c].categories.size()));
        text += char(c);
        text.append(codes[c].lengths.begin(), codes[c].lengths.end());
        text.append(codes[c].categories.begin(), codes[c].categories.end());
    }
    text += "\xff\xda"; // the scan
    put_short(text, 6 + 2 * samples.components);
    text += char(samples.components);
    for (int c = 0; c < samples.components; ++c)
        text += { char(c), char(c << 4) };
    text += { '\1', '\0', '\0' }; // predictor 1, no point transform
    return text;
}

} // namespace

std::string encode_lossless_jpeg(const JpegSamples& samples)
{
    const std::vector<std::int16_t> all = differences(samples);
    const std::size_t step = std::size_t(samples.components);
    CategoryCounts counts[kMostComponents] = {};
    for (std::size_t i = 0; i < all.size(); i += step)
        for (std::size_t c = 0; c < step; ++c)
            ++counts[c][std::size_t(category_of(all[i + c]))];
    HuffmanCode codes[kMostComponents];
    std::uint64_t bits = 0;
    for (std::size_t c = 0; c < step; ++c) {
        codes[c] = fit_huffman_code(counts[c]);
        for (std::size_t category = 0; category < counts[c].size(); ++category)
            bits += counts[c][category] * (codes[c].bits[category] + (category < 16 ? category : 0));
    }

    std::string text = header(samples, codes);
    const std::size_t begin = text.size();
    text.resize(begin + 2 * std::size_t(bits / 8 + 1) + 2); // every byte may need a zero after it
    auto* const data = reinterpret_cast<unsigned char*>(text.data());
    BitWriter writer(data + begin);
    for (std::size_t i = 0; i < all.size(); i += step)
        for (std::size_t c = 0; c < step; ++c) {
            const int difference = all[i + c], category = category_of(all[i + c]);
            // A category of 16 has one member. The others' are numbered from the most negative one.
            const int extra = category == 16 ? 0 : category;
            const std::uint32_t number = std::uint32_t(difference + (difference >> 31)) & ((1u << extra) - 1);
            writer.put(codes[c].code[std::size_t(category)] << extra | number,
                       codes[c].bits[std::size_t(category)] + extra);
        }
    unsigned char* end = writer.finish();
    *end++ = 0xff;
    *end++ = 0xd9;
    text.resize(std::size_t(end - data));
    text.shrink_to_fit(); // a file's tiles wait in memory until all are there
    return text;
}

} // namespace srisp
