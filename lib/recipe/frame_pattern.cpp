// SPDX-License-Identifier: Apache-2.0
#include "recipe/frame_pattern.h"

#include <algorithm>
#include <regex>

namespace srisp {

static std::string printf_pattern(const std::string& wildcard)
{
    int digits = 0;
    for (const char c : wildcard)
        digits += c == '#' ? 4 : 1;
    return "%0" + std::to_string(digits) + "d";
}

std::string frame_pattern_of_file(const std::string& path)
{
    const std::size_t folder = path.rfind('/') + 1; // 0 if there is none
    const std::size_t begin = path.find('#', folder);
    if (begin == std::string::npos)
        return path;
    const std::size_t end = std::min(path.find_first_not_of('#', begin), path.size());
    return path.substr(0, begin) + printf_pattern(path.substr(begin, end - begin)) + path.substr(end);
}

FrameWildcard find_frame_wildcard(const std::string& path)
{
    static const std::string one_range = "-?[0-9]+(?:--?[0-9]+(?:[xy]-?[0-9]+)?)?";
    static const std::regex wildcard("(" + one_range + "(?:," + one_range + ")*)?(?:[#@]+|%[0-9]*d)");
    const auto folder = path.begin() + static_cast<std::ptrdiff_t>(path.rfind('/') + 1);
    std::smatch match;
    if (!std::regex_search(folder, path.end(), match, wildcard))
        return {};
    return { std::size_t(match[0].first - path.begin()), std::size_t(match.length()), match[1].matched };
}

std::string frame_pattern_of_image(const std::string& path)
{
    const auto [begin, length, has_range] = find_frame_wildcard(path);
    if (length == 0)
        return path;
    const std::string wildcard = path.substr(begin, length);
    const std::size_t kept = wildcard.find_first_of("#@%");
    const std::string pattern = wildcard[kept] == '%' ? wildcard.substr(kept) : printf_pattern(wildcard.substr(kept));
    return path.substr(0, begin) + pattern + path.substr(begin + length);
}

std::string with_frame(const std::string& pattern, const std::string& frame)
{
    if (frame.empty())
        return pattern;
    std::smatch match;
    if (!std::regex_search(pattern, match, std::regex("#+|%(0?)([0-9]{0,2})d")))
        return pattern;
    const bool hashes = match.str()[0] == '#';
    const std::size_t width = hashes ? match.length() : match[2].length() ? std::stoul(match[2].str()) : 0;
    const std::string sign = frame[0] == '-' ? "-" : "";
    std::string digits = frame.substr(sign.size());
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
    if (sign.size() + digits.size() < width)
        digits.insert(0, width - sign.size() - digits.size(), '0');
    return match.prefix().str() + sign + digits + match.suffix().str();
}

} // namespace srisp
