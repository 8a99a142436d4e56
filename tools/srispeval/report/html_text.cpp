// SPDX-License-Identifier: Apache-2.0
#include "html_text.h"

#include <cmath>

#include "base/printed.h"
#include "base/shown_text.h"

namespace srisp::tool {

namespace {

constexpr char kMinus[] = "−";

std::string digits_of(double size, int digits)
{
    return std::abs(size) < 1e9 ? printed("%.*f", digits, size) : printed("%.*g", digits, size);
}

bool is_zero(const std::string& text)
{
    return text.find_first_not_of("0.") == std::string::npos;
}

std::string escaped(char letter)
{
    switch (letter) {
    case '&':
        return "&amp;";
    case '<':
        return "&lt;";
    case '>':
        return "&gt;";
    case '"':
        return "&quot;";
    case '\'':
        return "&#39;";
    default:
        break;
    }
    const auto byte = static_cast<unsigned char>(letter);
    if ((byte >= 0x20 && byte != 0x7f) || letter == '\n' || letter == '\t')
        return { letter };
    return printed("\\x%02x", unsigned(byte));
}

} // namespace

std::string html(std::string_view text)
{
    std::string escaped_text;
    for (const char letter : valid_utf8(text))
        escaped_text += escaped(letter);
    return escaped_text;
}

std::string number(double value, int digits)
{
    if (!std::isfinite(value))
        return kNothing;
    const std::string size = digits_of(std::abs(value), digits);
    return (value < 0 && !is_zero(size) ? kMinus : "") + size;
}

std::string signed_number(double value, int digits)
{
    const std::string text = number(value, digits);
    return (value > 0 && std::isfinite(value) && !is_zero(text) ? "+" : "") + text;
}

std::string coordinate(double value)
{
    std::string shortened = printed("%.1f", std::isfinite(value) ? value : 0.0);
    if (shortened.size() > 2 && shortened.compare(shortened.size() - 2, 2, ".0") == 0)
        shortened.resize(shortened.size() - 2);
    return shortened == "-0" ? "0" : shortened;
}

std::string range_text(const Interval& interval, int digits)
{
    if (!std::isfinite(interval.low) || !std::isfinite(interval.high))
        return "";
    return number(interval.low, digits) + " to " + number(interval.high, digits);
}

std::string signed_range_text(const Interval& interval, int digits)
{
    if (!std::isfinite(interval.low) || !std::isfinite(interval.high))
        return "";
    return signed_number(interval.low, digits) + " to " + signed_number(interval.high, digits);
}

std::string title_with_unit(const Metric& metric)
{
    return std::string(metric.title) + (*metric.unit ? " (" + std::string(metric.unit) + ")" : "");
}

} // namespace srisp::tool
