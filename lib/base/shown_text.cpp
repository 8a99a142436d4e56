// SPDX-License-Identifier: Apache-2.0
#include "base/shown_text.h"

#include "base/printed.h"

namespace srisp {

namespace {

unsigned byte_at(std::string_view text, std::size_t at)
{
    return static_cast<unsigned char>(text[at]);
}

/// Bytes of the character that a text begins with; 0 where that is no UTF-8 [RFC 3629: no surrogates, nothing longer
/// than it needs to be, nothing above U+10FFFF].
std::size_t character_bytes(std::string_view text)
{
    const unsigned first = byte_at(text, 0);
    if (first < 0x80)
        return 1;
    const std::size_t count = first >= 0xc2 && first <= 0xdf ? 2 : first >= 0xe0 && first <= 0xef ? 3 : 4;
    if (first < 0xc2 || first > 0xf4 || text.size() < count)
        return 0;
    const unsigned low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    const unsigned high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    if (byte_at(text, 1) < low || byte_at(text, 1) > high)
        return 0;
    for (std::size_t i = 2; i < count; ++i)
        if ((byte_at(text, i) & 0xc0) != 0x80)
            return 0;
    return count;
}

std::string escaped(unsigned byte)
{
    const char digits[] = "0123456789abcdef";
    return { '\\', 'x', digits[byte >> 4], digits[byte & 0xf] };
}

bool is_control(unsigned byte)
{
    return byte < 0x20 || byte == 0x7f;
}

} // namespace

std::string shown_text(std::string_view text, std::size_t most)
{
    std::string shown;
    while (!text.empty()) {
        const std::size_t bytes = character_bytes(text);
        const bool plain = bytes > 0 && !is_control(byte_at(text, 0));
        const std::string character = plain ? std::string(text.substr(0, bytes)) : escaped(byte_at(text, 0));
        if (shown.size() + character.size() > most)
            return shown + "…";
        shown += character;
        text.remove_prefix(plain ? bytes : 1);
    }
    return shown;
}

std::string shown_number(double value)
{
    return printed("%.6g", value);
}

std::string valid_utf8(std::string_view text)
{
    std::string valid;
    while (!text.empty()) {
        const std::size_t bytes = character_bytes(text);
        if (bytes > 0)
            valid += text.substr(0, bytes);
        else
            valid += escaped(byte_at(text, 0));
        text.remove_prefix(bytes > 0 ? bytes : 1);
    }
    return valid;
}

std::string_view first_characters(std::string_view text, std::size_t count)
{
    std::size_t end = 0;
    for (; count > 0 && end < text.size(); --count) {
        const std::size_t bytes = character_bytes(text.substr(end));
        end += bytes > 0 ? bytes : 1;
    }
    return text.substr(0, end);
}

} // namespace srisp
