// SPDX-License-Identifier: Apache-2.0
#include "output_depth.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "../common/failure.h"
#include "command_line.h"

namespace srisp::tool {

/// Words of a list that is separated by spaces.
static bool contains_word(const char* list, const std::string& word)
{
    return !word.empty() && (" " + std::string(list) + " ").find(" " + word + " ") != std::string::npos;
}

static std::string extension_of(const std::string& name)
{
    std::string extension = name.substr(name.find_last_of("./") + 1);
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return extension;
}

Depth deepest(const std::string& name)
{
    // Measured with oiiotool 2.4.7: what each writer makes of float pixels. Extensions and format names of
    // `oiiotool --list-formats`.
    const std::string extension = extension_of(name);
    if (contains_word("png iff z sgi rgb rgba bw int inta jp2 j2k j2c jpeg2000", extension))
        return Depth::sixteen;
    if (contains_word(
            "jpg jpe jpeg jif jfif jfi bmp dib gif ico tga tpic targa webp heic heif heics avif ppm pgm pbm pnm",
            extension))
        return Depth::eight;
    return Depth::any;
}

/// Modifiers of a command that is not ours to criticise: none if they are malformed.
static Modifiers oiiotool_modifiers(const std::string& word)
{
    try {
        return parse_modifiers(word);
    } catch (const Failure&) {
        return {};
    }
}

std::string output_format(const std::vector<std::string>& words)
{
    std::string format = words[1];
    for (const auto& [name, value] : oiiotool_modifiers(words[0]))
        if (name == "fileformatname")
            format = value;
    return extension_of(format);
}

bool holds_orientation(const std::string& format)
{
    // Measured with OpenImageIO 2.4.7: DPX, FITS, JPEG, EXR and TIFF do; PNG by our guard.
    return !contains_word("bmp dib gif hdr rgbe heic heif heics avif ico iff z ppm pgm pbm pnm rla sgi rgb rgba bw int "
                          "inta tga tpic targa webp jp2 j2k j2c jpeg2000 zfile",
                          format);
}

std::string choose_depth(std::vector<std::string>& words)
{
    for (const char* name : { "datatype", "type", "bits" })
        if (has_modifier(words[0], name))
            return {};
    const Depth depth = deepest(output_format(words));
    if (depth == Depth::sixteen)
        words[0] += ":datatype=uint16";
    if (depth != Depth::eight)
        return {};
    return "'" + words[1] +
           "' holds 8 bits per channel, few for linear values; write EXR, TIFF or PNG, or say '-d uint8' to keep this "
           "format without this warning";
}

/// What a modifier of an output command says; "": nothing.
static std::string modifier_of(const std::string& word, const std::string& wanted)
{
    for (const auto& [name, value] : oiiotool_modifiers(word))
        if (name == wanted)
            return value;
    return {};
}

bool writes_dng(const Step& step)
{
    return step.is_named("o") && step.words.size() > 1 && output_format(step.words) == "dng";
}

bool writes_integers(const std::vector<Step>& steps, std::size_t first)
{
    std::string depth;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const std::vector<std::string>& words = steps[i].words;
        if (steps[i].is_named("d") && words.size() > 1)
            depth = words[1];
        if (i < first || !steps[i].is_named("o") || words.size() < 2 || writes_dng(steps[i]))
            continue;
        const std::string own = modifier_of(words[0], "datatype");
        const std::string& type = own.empty() ? depth : own;
        if (type.find("int") != std::string::npos || deepest(output_format(words)) != Depth::any)
            return true;
    }
    return false;
}

Modifiers take_dng_options(std::vector<std::string>& words, const std::string& depth)
{
    Modifiers attributes;
    std::string type = depth, rest = words[0].substr(0, words[0].find(':'));
    for (const auto& [name, value] : parse_modifiers(words[0])) {
        if (name == "layout" || name == "bits")
            attributes.emplace_back("dng:" + name, value);
        else if (name == "compression")
            attributes.emplace_back(name, value);
        else if (name == "datatype" || name == "type")
            type = value;
        else
            rest += ":" + name + "=" + value;
    }
    words[0] = rest;
    if (type == "half" || type == "float")
        attributes.emplace_back("dng:datatype", type);
    return attributes;
}

} // namespace srisp::tool
