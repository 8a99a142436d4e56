// SPDX-License-Identifier: Apache-2.0
#include "base64.h"

#include <algorithm>
#include <cstdint>
#include <string>

namespace srisp::tool {

namespace {

constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// One to three bytes as four digits.
void add_group(std::string& text, std::string_view bytes)
{
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 3; ++i)
        bits = bits << 8 | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u);
    for (std::size_t i = 0; i < 4; ++i)
        text += i <= bytes.size() ? kDigits[bits >> (18 - 6 * i) & 63] : '=';
}

} // namespace

void write_base64(ByteSink& out, std::string_view bytes)
{
    constexpr std::size_t kPiece = 3 * 4096;
    std::string text;
    for (std::size_t begin = 0; begin < bytes.size(); begin += kPiece) {
        const std::string_view piece = bytes.substr(begin, kPiece);
        text.clear();
        for (std::size_t at = 0; at < piece.size(); at += 3)
            add_group(text, piece.substr(at, 3));
        out.write(text);
    }
}

} // namespace srisp::tool
