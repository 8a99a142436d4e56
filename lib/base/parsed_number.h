// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace srisp {

/// The finite number that the whole text is, with a point in any locale; none: it is something else, or does not fit
/// into T.
template<class T> std::optional<T> parsed_number(std::string_view text)
{
    T number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size())
        return {};
    if constexpr (std::is_floating_point_v<T>)
        if (!std::isfinite(number))
            return {};
    return number;
}

/// The same; a plus sign may stand before it.
template<class T> std::optional<T> parsed_signed_number(std::string_view text)
{
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.remove_prefix(1);
    return parsed_number<T>(text);
}

/// The same; blanks may stand around it, too, as in files that people write.
template<class T> std::optional<T> lenient_number(std::string_view text)
{
    constexpr const char* blanks = " \t\r\n";
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return parsed_signed_number<T>(text.substr(0, text.find_last_not_of(blanks) + 1));
}

} // namespace srisp
