// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace srisp::plugin {

/// The rows of an image in memory, each in the smallest type (8 bits, 16 bits, half, float) that gives all its floats
/// back to the bit: hosts hand over floats, also of photos that had a byte for each. Rows that were not put are black.
class KeptRows {
public:
    KeptRows(std::size_t rows, std::size_t row_values) : m_rows(rows), m_row_values(row_values) {}

    void put(std::size_t row, const float* values);
    /// Some values of a row, whose others stay. It is kept as floats until `pack`.
    void put_part(std::size_t row, std::size_t first, std::size_t count, const float* values);
    void pack();

    void get(std::size_t row, float* values) const;

    /// How much memory the rows take.
    std::size_t bytes() const;

private:
    enum class Type { none, bits8, bits16, half, float32 };
    struct Row {
        Type type = Type::none;
        std::unique_ptr<unsigned char[]> bytes;
    };

    std::size_t bytes_of(Type type) const;

    std::vector<Row> m_rows;
    std::size_t m_row_values;
    std::vector<std::size_t> m_unpacked; ///< rows of which parts were put
};

} // namespace srisp::plugin
