// SPDX-License-Identifier: Apache-2.0
#include "shell_quote.h"

namespace srisp::tool {

static bool is_plain(const std::string& word)
{
    const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:%@";
    return !word.empty() && word.find_first_not_of(plain) == std::string::npos;
}

static std::string quoted(const std::string& word)
{
    std::string text = "'";
    for (const char c : word)
        text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string shell_line(const std::vector<std::string>& words)
{
    std::string line;
    for (const std::string& word : words)
        line += (line.empty() ? "" : " ") + (is_plain(word) ? word : quoted(word));
    return line;
}

} // namespace srisp::tool
