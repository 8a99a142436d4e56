// SPDX-License-Identifier: Apache-2.0
#include "kept_rows.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <OpenImageIO/imageio.h>

#include "photo/code_values.h"

namespace srisp::plugin {

namespace {

bool same_bits(float a, float b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

/// False: some value is none of those that the codes of an integer type stand for.
template<class Code> bool pack_codes(const float* values, std::size_t count, Code* codes)
{
    const float* const value_of = code_values<Code>();
    for (std::size_t i = 0; i < count; ++i) {
        if (!(values[i] >= 0 && values[i] <= 1))
            return false;
        const auto code = static_cast<Code>(values[i] * float(kCodeCount<Code> - 1) + 0.5f);
        if (!same_bits(value_of[code], values[i]))
            return false;
        codes[i] = code;
    }
    return true;
}

void unpack_halves(const unsigned char* halves, std::size_t count, float* values)
{
    OIIO::convert_pixel_values(OIIO::TypeHalf, halves, OIIO::TypeFloat, values, static_cast<int>(count));
}

/// As Codes does.
bool pack_halves(const float* values, std::size_t count, unsigned char* halves)
{
    OIIO::convert_pixel_values(OIIO::TypeFloat, values, OIIO::TypeHalf, halves, static_cast<int>(count));
    std::vector<float> back(count);
    unpack_halves(halves, count, back.data());
    return std::memcmp(back.data(), values, count * sizeof(float)) == 0;
}

template<class Value> Value* as(unsigned char* bytes)
{
    return reinterpret_cast<Value*>(bytes); // memory of new[]: aligned for any
}
template<class Value> const Value* as(const unsigned char* bytes)
{
    return reinterpret_cast<const Value*>(bytes);
}

} // namespace

std::size_t KeptRows::bytes_of(Type type) const
{
    static constexpr std::size_t kBytes[] = { 0, 1, 2, 2, 4 };
    return kBytes[int(type)] * m_row_values;
}

void KeptRows::put(std::size_t row, const float* values)
{
    for (const Type type : { Type::bits8, Type::bits16, Type::half, Type::float32 }) {
        std::unique_ptr<unsigned char[]> bytes(new unsigned char[bytes_of(type)]);
        bool packed = true;
        if (type == Type::bits8)
            packed = pack_codes<std::uint8_t>(values, m_row_values, bytes.get());
        else if (type == Type::bits16)
            packed = pack_codes(values, m_row_values, as<std::uint16_t>(bytes.get()));
        else if (type == Type::half)
            packed = pack_halves(values, m_row_values, bytes.get());
        else
            std::copy_n(values, m_row_values, as<float>(bytes.get()));
        if (packed) {
            m_rows[row] = { type, std::move(bytes) };
            return;
        }
    }
}

void KeptRows::put_part(std::size_t row, std::size_t first, std::size_t count, const float* values)
{
    if (m_rows[row].type != Type::float32) {
        std::unique_ptr<unsigned char[]> floats(new unsigned char[bytes_of(Type::float32)]);
        get(row, as<float>(floats.get()));
        m_unpacked.push_back(row);
        m_rows[row] = { Type::float32, std::move(floats) };
    }
    std::copy_n(values, count, as<float>(m_rows[row].bytes.get()) + first);
}

void KeptRows::pack()
{
    for (const std::size_t row : m_unpacked) {
        const auto floats = std::move(m_rows[row].bytes);
        put(row, as<float>(floats.get()));
    }
    m_unpacked.clear();
}

void KeptRows::get(std::size_t row, float* values) const
{
    const unsigned char* const bytes = m_rows[row].bytes.get();
    switch (m_rows[row].type) {
    case Type::none:
        std::fill_n(values, m_row_values, 0.0f);
        break;
    case Type::bits8:
        codes_to_floats<std::uint8_t>(bytes, m_row_values, values);
        break;
    case Type::bits16:
        codes_to_floats(as<std::uint16_t>(bytes), m_row_values, values);
        break;
    case Type::half:
        unpack_halves(bytes, m_row_values, values);
        break;
    case Type::float32:
        std::copy_n(as<float>(bytes), m_row_values, values);
        break;
    }
}

std::size_t KeptRows::bytes() const
{
    std::size_t sum = 0;
    for (const Row& row : m_rows)
        sum += bytes_of(row.type);
    return sum;
}

} // namespace srisp::plugin
