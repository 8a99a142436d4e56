// SPDX-License-Identifier: Apache-2.0
#include "output_depth.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace srisp::tool {

/// Words of a list that is separated by spaces.
static bool contains_word(const char* list, const std::string& word)
{
    return !word.empty() && (" " + std::string(list) + " ").find(" " + word + " ") != std::string::npos;
}

Depth deepest(const std::string& name)
{
    // Measured with oiiotool 2.4.7: what each writer makes of float pixels. Extensions and format names of
    // `oiiotool --list-formats`.
    std::string extension = name.substr(name.find_last_of("./") + 1);
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    if (contains_word("png iff z sgi rgb rgba bw int inta jp2 j2k j2c jpeg2000", extension))
        return Depth::sixteen;
    if (contains_word(
            "jpg jpe jpeg jif jfif jfi bmp dib gif ico tga tpic targa webp heic heif heics avif ppm pgm pbm pnm",
            extension))
        return Depth::eight;
    return Depth::any;
}

} // namespace srisp::tool
