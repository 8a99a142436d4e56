// SPDX-License-Identifier: Apache-2.0
#include "recipe/frame_pattern.h"

#include <algorithm>
#include <climits>
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
    if (path.end() - folder > NAME_MAX) // no file is called so, and std::regex calls itself for every character
        return {};
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

/// Where a frame number belongs, and its least number of digits.
struct Place {
    std::size_t begin = 0, length = 0, width = 0;
};

/// The first run of '#', or %d with at most two digits behind a zero, that is in a pattern.
static Place find_place(const std::string& pattern)
{
    for (std::size_t begin = pattern.find_first_of("#%"); begin != std::string::npos;
         begin = pattern.find_first_of("#%", begin + 1)) {
        if (pattern[begin] == '#') {
            const std::size_t length = std::min(pattern.find_first_not_of('#', begin), pattern.size()) - begin;
            return { begin, length, length };
        }
        const std::size_t end = std::min(pattern.find_first_not_of("0123456789", begin + 1), pattern.size());
        const std::string digits = pattern.substr(begin + 1, end - begin - 1);
        const std::size_t most = digits[0] == '0' ? 3 : 2;
        if (end < pattern.size() && pattern[end] == 'd' && digits.size() <= most)
            return { begin, end + 1 - begin, digits.empty() ? 0 : std::stoul(digits) };
    }
    return {};
}

std::string with_frame(const std::string& pattern, const std::string& frame)
{
    if (frame.empty())
        return pattern;
    const Place place = find_place(pattern);
    if (place.length == 0)
        return pattern;
    const std::string sign = frame[0] == '-' ? "-" : "";
    std::string digits = frame.substr(sign.size());
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
    if (sign.size() + digits.size() < place.width)
        digits.insert(0, place.width - sign.size() - digits.size(), '0');
    return pattern.substr(0, place.begin) + sign + digits + pattern.substr(place.begin + place.length);
}

} // namespace srisp
