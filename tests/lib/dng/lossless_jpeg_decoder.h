// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

/// A plain decoder of lossless JPEGs, straight from T.81, to hold the encoder against.
class LosslessJpegDecoder {
public:
    explicit LosslessJpegDecoder(const std::string& jpeg) : m_data(jpeg) { read(); }

    int columns = 0, rows = 0, components = 0, bits = 0;
    std::vector<std::uint16_t> samples;

private:
    struct Table {
        int lengths[17] = {};
        std::vector<int> categories;
    };

    int byte()
    {
        if (m_at >= m_data.size())
            throw std::runtime_error("JPEG ends early");
        return static_cast<unsigned char>(m_data[m_at++]);
    }
    int two()
    {
        const int high = byte();
        return high << 8 | byte();
    }
    static void need(bool condition)
    {
        if (!condition)
            throw std::runtime_error("not such a JPEG");
    }

    void read()
    {
        need(two() == 0xffd8);
        for (;;) {
            const int marker = two();
            const std::size_t end = m_at + std::size_t(two());
            if (marker == 0xffc3) {
                bits = byte();
                rows = two();
                columns = two();
                components = byte();
                for (int c = 0; c < components; ++c)
                    need(byte() == c && byte() == 0x11 && byte() == 0);
            } else if (marker == 0xffc4) {
                Table& table = m_tables[byte()];
                int count = 0;
                for (int length = 1; length <= 16; ++length)
                    count += table.lengths[length] = byte();
                while (count-- > 0)
                    table.categories.push_back(byte());
            } else {
                need(marker == 0xffda && byte() == components);
                for (int c = 0; c < components; ++c)
                    need(byte() == c && byte() == c << 4);
                need(byte() == 1 && byte() == 0 && byte() == 0);
            }
            need(m_at == end);
            if (marker == 0xffda)
                break;
        }
        read_samples();
        while (m_left > 0) // what fills the last byte
            need(bit() == 1);
        need(two() == 0xffd9 && m_at == m_data.size());
    }

    int bit()
    {
        if (m_left == 0) {
            m_byte = byte();
            if (m_byte == 0xff)
                need(byte() == 0);
            m_left = 8;
        }
        return m_byte >> --m_left & 1;
    }

    int difference(const Table& table)
    {
        int code = 0, first = 0, index = 0, category = -1;
        for (int length = 1; length <= 16 && category < 0; ++length) {
            code = code << 1 | bit();
            first <<= 1;
            if (code - first < table.lengths[length])
                category = table.categories.at(std::size_t(index + code - first));
            index += table.lengths[length];
            first += table.lengths[length];
        }
        need(category >= 0);
        if (category == 16)
            return 32768;
        int value = 0;
        for (int i = 0; i < category; ++i)
            value = value << 1 | bit();
        return category > 0 && value < 1 << (category - 1) ? value - (1 << category) + 1 : value;
    }

    void read_samples()
    {
        const std::size_t step = std::size_t(components), row = step * std::size_t(columns);
        samples.resize(row * std::size_t(rows));
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const bool first_column = i % row < step;
            const int prediction = !first_column ? samples[i - step] : i >= row ? samples[i - row] : 1 << (bits - 1);
            samples[i] = std::uint16_t(prediction + difference(m_tables[i % step]));
        }
    }

    const std::string& m_data;
    std::size_t m_at = 0;
    int m_byte = 0, m_left = 0;
    Table m_tables[4];
};
