// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace srisp {

/// Categories of differences in lossless JPEG: how many bits a difference needs, 0 to 16. [T.81 H.1.2.2]
constexpr int kDifferenceCategories = 17;
using CategoryCounts = std::array<std::uint64_t, kDifferenceCategories>;

/// A Huffman code of at most 16 bits, as a JPEG file states it.
struct HuffmanCode {
    std::array<std::uint8_t, 16> lengths{}; ///< how many codes have 1, 2, … 16 bits
    std::vector<std::uint8_t> categories;   ///< by rising code
    std::array<std::uint32_t, kDifferenceCategories> code{};
    std::array<std::uint8_t, kDifferenceCategories> bits{}; ///< of each code; 0: the category does not occur
};

/// The best code for how often each category occurs; at least one must. No code is all ones. [T.81 K.2, C.2]
HuffmanCode fit_huffman_code(const CategoryCounts& counts);

} // namespace srisp
