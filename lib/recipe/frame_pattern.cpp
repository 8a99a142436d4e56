// SPDX-License-Identifier: Apache-2.0
#include "recipe/frame_pattern.h"

#include <algorithm>
#include <regex>

namespace srisp {

/// `wildcards`: the characters that stand for digits; `range`: those that may stand before them.
static std::string frame_pattern(const std::string& path, const char* wildcards, const char* range)
{
    const std::size_t folder = path.rfind('/') + 1; // 0 if there is none
    const std::size_t begin = path.find_first_of(wildcards, folder);
    if (begin == std::string::npos)
        return path;
    const std::size_t end = std::min(path.find_first_not_of(wildcards, begin), path.size());
    int digits = 0;
    for (std::size_t i = begin; i < end; ++i)
        digits += path[i] == '#' ? 4 : 1;
    const std::size_t last_kept = path.find_last_not_of(range, begin - 1);
    const std::size_t kept =
        begin == folder || last_kept == std::string::npos ? folder : std::max(last_kept + 1, folder);
    return path.substr(0, kept) + "%0" + std::to_string(digits) + "d" + path.substr(end);
}

std::string frame_pattern_of_file(const std::string& path)
{
    return frame_pattern(path, "#", "");
}

std::string frame_pattern_of_image(const std::string& path)
{
    return frame_pattern(path, "#@", "0123456789-,xy");
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
