// SPDX-License-Identifier: Apache-2.0
#include "dng/huffman_code.h"

#include <algorithm>
#include <cstddef>

namespace srisp {

namespace {

constexpr std::size_t kLongestCode = 16;

/// A part of the tree: how often, and which symbols hang on it.
struct Branch {
    std::uint64_t count;
    std::vector<int> symbols;
};

/// How many codes there are of each length, and each symbol's own. The last symbol never occurs; it gets the longest
/// code, of all ones, which is left out later.
std::array<int, 33> code_lengths(const CategoryCounts& counts, std::array<int, kDifferenceCategories + 1>& length)
{
    std::vector<Branch> branches{ { 0, { kDifferenceCategories } } };
    for (int category = 0; category < kDifferenceCategories; ++category)
        if (counts[std::size_t(category)] > 0)
            branches.push_back({ counts[std::size_t(category)], { category } });
    while (branches.size() > 1) {
        std::stable_sort(branches.begin(), branches.end(),
                         [](const Branch& a, const Branch& b) { return a.count < b.count; });
        Branch& joined = branches[1];
        joined.count += branches[0].count;
        joined.symbols.insert(joined.symbols.end(), branches[0].symbols.begin(), branches[0].symbols.end());
        for (const int symbol : joined.symbols)
            ++length[std::size_t(symbol)];
        branches.erase(branches.begin());
    }
    std::array<int, 33> number{};
    for (const int one : length)
        number[std::size_t(one)] += one > 0;
    return number;
}

/// Shortens the codes that are too long: two of them move up, one that is shorter makes place. [T.81 K.3]
void limit_lengths(std::array<int, 33>& number)
{
    for (std::size_t length = 32; length > kLongestCode; --length)
        while (number[length] > 0) {
            std::size_t shorter = length - 2;
            while (number[shorter] == 0)
                --shorter;
            number[length] -= 2;
            ++number[length - 1];
            number[shorter + 1] += 2;
            --number[shorter];
        }
}

} // namespace

HuffmanCode fit_huffman_code(const CategoryCounts& counts)
{
    std::array<int, kDifferenceCategories + 1> length{};
    std::array<int, 33> number = code_lengths(counts, length);
    limit_lengths(number);
    std::size_t longest = kLongestCode;
    while (number[longest] == 0)
        --longest;
    --number[longest]; // the code of all ones

    HuffmanCode result;
    std::vector<std::uint8_t> order;
    for (int category = 0; category < kDifferenceCategories; ++category)
        if (counts[std::size_t(category)] > 0)
            order.push_back(std::uint8_t(category));
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return length[std::size_t(a)] < length[std::size_t(b)]; });
    result.categories = order;
    std::uint32_t code = 0;
    std::size_t next = 0;
    for (std::size_t bits = 1; bits <= kLongestCode; ++bits, code <<= 1) {
        result.lengths[bits - 1] = std::uint8_t(number[bits]);
        for (int i = 0; i < number[bits]; ++i, ++next, ++code) {
            result.code[order[next]] = code;
            result.bits[order[next]] = std::uint8_t(bits);
        }
    }
    return result;
}

} // namespace srisp
