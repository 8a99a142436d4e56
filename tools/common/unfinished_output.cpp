// SPDX-License-Identifier: Apache-2.0
#include "unfinished_output.h"

#include <algorithm>
#include <cctype>

namespace srisp::tool {

/// Whether it ends with `.XXXXXXXX.temp`.
static bool is_stem(std::string_view name)
{
    constexpr std::string_view mark = ".temp";
    constexpr std::size_t digits = 8;
    if (name.size() < mark.size() + digits + 1 || name.substr(name.size() - mark.size()) != mark)
        return false;
    name.remove_suffix(mark.size());
    const std::string_view random = name.substr(name.size() - digits);
    return name[name.size() - digits - 1] == '.' &&
           std::all_of(random.begin(), random.end(), [](unsigned char c) { return std::isxdigit(c); });
}

bool is_unfinished_output(std::string_view path)
{
    const std::string_view name = path.substr(path.rfind('/') + 1); // npos + 1 is 0
    return is_stem(name) || is_stem(name.substr(0, std::min(name.rfind('.'), name.size())));
}

} // namespace srisp::tool
