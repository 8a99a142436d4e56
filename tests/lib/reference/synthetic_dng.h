// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

/// A small DNG in memory: tags by number, pixels in one uncompressed strip. Starts as a 40 × 30 RGGB mosaic of 16 bits.
class SyntheticDng {
public:
    enum Type {
        kByte = 1,
        kAscii = 2,
        kShort = 3,
        kLong = 4,
        kRational = 5,
        kSRational = 10,
        kFloat = 11,
        kDouble = 12
    };

    SyntheticDng()
    {
        set(254, kLong, { 0 }).set(258, kShort, { 16 }).set(259, kShort, { 1 }).set(262, kShort, { 32803 });
        set(277, kShort, { 1 }).set(33421, kShort, { 2, 2 }).set(33422, kByte, { 0, 1, 1, 2 });
        set(50706, kByte, { 1, 4, 0, 0 }).set(50717, kLong, { 65535 });
        resize(40, 30);
    }

    SyntheticDng& resize(int new_width, int new_height)
    {
        width = new_width;
        height = new_height;
        return set(256, kLong, { double(width) }).set(257, kLong, { double(height) });
    }

    SyntheticDng& set(int tag, Type type, std::vector<double> values)
    {
        m_tags[tag] = { type, std::move(values) };
        return *this;
    }
    SyntheticDng& erase(int tag)
    {
        m_tags.erase(tag);
        return *this;
    }

    /// Sets all 16-bit samples from (x, y, sample).
    SyntheticDng& fill(const std::function<double(int, int, int)>& value, int samples = 1)
    {
        pixels.clear();
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int s = 0; s < samples; ++s)
                    put(pixels, std::uint64_t(value(x, y, s)), 2);
        return *this;
    }
    /// The same for 32-bit floats.
    SyntheticDng& fill_float(const std::function<float(int, int, int)>& value, int samples)
    {
        set(258, kShort, std::vector<double>(std::size_t(samples), 32)).set(339, kShort, { 3 });
        pixels.clear();
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int s = 0; s < samples; ++s)
                    put_value(pixels, kFloat, double(value(x, y, s)));
        return *this;
    }
    /// Turns it into demosaiced RGB.
    SyntheticDng& linear()
    {
        return set(262, kShort, { 34892 })
            .set(277, kShort, { 3 })
            .set(258, kShort, { 16, 16, 16 })
            .erase(33421)
            .erase(33422);
    }

    /// The file. Tags 273 and 279 (strip offset and size) are made here unless they were set.
    std::string bytes() const
    {
        auto tags = m_tags;
        if (!tags.count(279))
            tags[279] = { kLong, { double(pixels.size()) } };
        const bool place_strip = tags.emplace(273, Tag{ kLong, { 0 } }).second;
        const std::size_t folder_bytes = 2 + 12 * tags.size() + 4;
        std::string values; // those of more than 4 bytes, behind the folder
        for (const auto& [number, tag] : tags)
            if (const std::string v = encoded(tag); v.size() > 4)
                values += v;
        const std::size_t strip = 8 + folder_bytes + values.size();
        if (place_strip)
            tags[273].values = { double(strip) };

        std::string file = big_endian ? std::string("MM\0*", 4) : std::string("II*\0", 4), far;
        put(file, 8, 4);
        put(file, tags.size(), 2);
        for (const auto& [number, tag] : tags) {
            std::string v = encoded(tag);
            put(file, std::uint64_t(number), 2);
            put(file, tag.type, 2);
            put(file, tag.values.size(), 4);
            if (v.size() > 4) {
                put(file, 8 + folder_bytes + far.size(), 4);
                far += v;
            } else {
                v.resize(4);
                file += v;
            }
        }
        put(file, 0, 4);
        return file + far + pixels;
    }

    int width = 0, height = 0;
    bool big_endian = false; ///< set it before filling
    std::string pixels;

private:
    struct Tag {
        Type type;
        std::vector<double> values;
    };

    void put(std::string& out, std::uint64_t value, int count) const
    {
        for (int i = 0; i < count; ++i)
            out += char(value >> 8 * (big_endian ? count - 1 - i : i) & 255);
    }
    void put_value(std::string& out, Type type, double value) const
    {
        const float single = float(value);
        std::uint32_t bits;
        std::uint64_t wide;
        std::memcpy(&bits, &single, 4);
        std::memcpy(&wide, &value, 8);
        switch (type) {
        case kByte:
        case kAscii:
            return put(out, std::uint64_t(value), 1);
        case kShort:
            return put(out, std::uint64_t(value), 2);
        case kLong:
            return put(out, std::uint64_t(value), 4);
        case kFloat:
            return put(out, bits, 4);
        case kDouble:
            return put(out, wide, 8);
        case kRational:
        case kSRational:
            put(out, std::uint64_t(std::int64_t(value * 10000)), 4);
            return put(out, 10000, 4);
        }
    }
    std::string encoded(const Tag& tag) const
    {
        std::string out;
        for (const double value : tag.values)
            put_value(out, tag.type, value);
        return out;
    }

    std::map<int, Tag> m_tags;
};
