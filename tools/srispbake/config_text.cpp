// SPDX-License-Identifier: Apache-2.0
#include "config_text.h"

#include <algorithm>
#include <sstream>

#include "../common/failure.h"
#include "base/printed.h"

namespace srisp::tool {

namespace {

constexpr std::size_t kIndent = 2; // of the lines that are given

std::string trimmed(const std::string& text)
{
    const std::size_t first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

bool is_blank_or_comment(const std::string& line)
{
    const std::string text = trimmed(line);
    return text.empty() || text[0] == '#';
}

/// What may stand for "nothing in here".
bool is_empty_collection(const std::string& text)
{
    return text == "{}" || text == "[]";
}

std::size_t indent_of(const std::string& line)
{
    return line.find_first_not_of(' ');
}

} // namespace

YamlSections::YamlSections(const std::string& text)
{
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        m_lines.push_back(line);
}

std::size_t YamlSections::find(const std::string& section) const
{
    const auto is_section = [&](const std::string& line) { return line.rfind(section + ":", 0) == 0; };
    return std::size_t(std::find_if(m_lines.begin(), m_lines.end(), is_section) - m_lines.begin());
}

bool YamlSections::has(const std::string& section) const
{
    return find(section) < m_lines.size();
}

/// After the last line that belongs to it; comments before the next section are that one's.
std::size_t YamlSections::end_of(std::size_t section) const
{
    std::size_t end = section + 1;
    for (std::size_t i = section + 1; i < m_lines.size(); ++i) {
        if (is_blank_or_comment(m_lines[i]))
            continue;
        const char first = m_lines[i][0];
        if (first != ' ' && first != '-')
            break;
        end = i + 1;
    }
    return end;
}

void YamlSections::append(const std::string& section, const std::vector<std::string>& lines)
{
    std::size_t key = find(section);
    if (key == m_lines.size()) {
        m_lines.push_back("");
        m_lines.push_back(section + ":");
        key = m_lines.size() - 1;
    }
    std::string value = trimmed(m_lines[key].substr(section.size() + 1));
    if (!value.empty() && value[0] == '#')
        value.clear();
    std::size_t end = end_of(key), indent = kIndent;
    if (is_empty_collection(value)) {
        m_lines[key] = section + ":";
    } else if (!value.empty()) {
        fail("section '" + section + "' is written as '" + value.substr(0, 20) +
             "…'; entries can be added to one with a line for each");
    } else if (end == key + 2 && is_empty_collection(trimmed(m_lines[key + 1]))) {
        m_lines.erase(m_lines.begin() + std::ptrdiff_t(key) + 1);
        end = key + 1;
    } else {
        const auto last = m_lines.begin() + std::ptrdiff_t(end);
        const auto first = std::find_if_not(m_lines.begin() + std::ptrdiff_t(key) + 1, last, is_blank_or_comment);
        indent = first == last ? kIndent : indent_of(*first);
    }
    std::vector<std::string> added;
    for (const std::string& line : lines)
        added.push_back(line.empty() ? line : std::string(indent, ' ') + line.substr(kIndent));
    m_lines.insert(m_lines.begin() + std::ptrdiff_t(end), added.begin(), added.end());
}

void YamlSections::set(const std::string& section, const std::string& value)
{
    const std::string line = section + ": " + value;
    if (has(section))
        m_lines[find(section)] = line;
    else
        m_lines.insert(m_lines.end(), { "", line });
}

std::string YamlSections::text() const
{
    std::string text;
    for (const std::string& line : m_lines)
        text += line + "\n";
    return text;
}

namespace {

const char kUnprocess[] = "!<FileTransform> {src: \"${SRISP_REFERENCE}.unprocess.clf\", interpolation: best}";
const char kProcess[] = "!<FileTransform> {src: \"${SRISP_REFERENCE}.process.clf\", interpolation: best}";
const char kDevelop[] = "!<FileTransform> {src: \"${SRISP_REFERENCE}.develop.clf\", interpolation: best}";
const char kUndevelop[] =
    "!<FileTransform> {src: \"${SRISP_REFERENCE}.develop.clf\", interpolation: best, direction: inverse}";
const char kToAcescg[] = "!<BuiltinTransform> {style: ACEScg_to_ACES2065-1, direction: inverse}";
const char kFromAcescg[] = "!<BuiltinTransform> {style: ACEScg_to_ACES2065-1}";
const char kDecode[] = "!<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: forward}";
const char kEncode[] = "!<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}";

/// ACES2065-1 → linear sRGB, white to white (Bradford).
constexpr std::array<double, 9> kAcesToLinearSrgb = { 2.52168618674,   -1.13413098824,  -0.387555198504,
                                                      -0.27647991423,  1.37271908767,   -0.0962391734383,
                                                      -0.015378064966, -0.152975335867, 1.16835340083 };

std::string matrix_text(const std::array<double, 9>& m, const char* direction)
{
    std::string text = "!<MatrixTransform> {matrix: [";
    for (int row = 0; row < 3; ++row)
        text += printed("%.10g, %.10g, %.10g, 0, ", m[row * 3], m[row * 3 + 1], m[row * 3 + 2]);
    return text + "0, 0, 0, 1], direction: " + direction + "}";
}

std::string look(const char* name, const char* space, const char* description, const char* there, const char* back)
{
    return std::string("\n  - !<Look>\n    name: ") + name + "\n    process_space: " + space +
           "\n    description: " + description + "\n    transform: " + there + "\n    inverse_transform: " + back +
           "\n";
}

struct Space {
    const char *name, *aliases, *description, *encoding;
    std::vector<std::string> to_reference, from_reference;
};

std::string group(const char* key, const std::vector<std::string>& children)
{
    std::string text = std::string("    ") + key + ": !<GroupTransform>\n      children:\n";
    for (const std::string& child : children)
        text += "        - " + child + "\n";
    return text;
}

std::string color_space(const Space& space)
{
    return std::string("\n  - !<ColorSpace>\n    name: ") + space.name + "\n    aliases: [" + space.aliases +
           "]\n    family: srisp\n    equalitygroup: \"\"\n    bitdepth: 32f\n    description: " + space.description +
           "\n    isdata: false\n    encoding: " + space.encoding + "\n    allocation: uniform\n" +
           group("to_scene_reference", space.to_reference) + group("from_scene_reference", space.from_reference);
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

} // namespace

const std::vector<AddedVariable> kAddedVariables = { { "SRISP_MODEL", "default" },
                                                     { "SRISP_REFERENCE", "srisp_neutral" },
                                                     { "SRISP_SOURCE", "" } };
const std::vector<std::string> kAddedLooks = { "srisp unprocess", "srisp process" };
const std::vector<std::string> kAddedColorSpaces = { "srisp linear sRGB", "srisp sRGB",         "srisp camera RGB",
                                                     "srisp process",     "srisp scene linear", "srisp ACEScg",
                                                     "srisp photo" };
const std::vector<std::string> kAddedAliases = { "srisp_linear_srgb", "srisp_srgb",    "camera_rgb",
                                                 "srisp_camera_rgb",  "srisp_process", "srisp_scene_linear",
                                                 "srisp_acescg",      "srisp_photo" };

ConfigEntries config_entries(const std::array<double, 9>& to_reference)
{
    const std::string to = matrix_text(to_reference, "forward"), from = matrix_text(to_reference, "inverse");
    const std::string from_aces = matrix_text(kAcesToLinearSrgb, "forward"),
                      to_aces = matrix_text(kAcesToLinearSrgb, "inverse");
    const std::string looks =
        look("srisp unprocess", "srisp sRGB",
             "Photo to the camera RGB of the reference. Take sRGB as input and output space.", kUnprocess, kProcess) +
        look("srisp process", "srisp linear sRGB",
             "Camera RGB of the reference to the picture. Take linear sRGB as input and output space.", kProcess,
             kUnprocess);
    const std::string spaces =
        color_space({ "srisp linear sRGB",
                      "srisp_linear_srgb",
                      "Linear light with sRGB primaries.",
                      "scene-linear",
                      { to },
                      { from } }) +
        color_space({ "srisp sRGB",
                      "srisp_srgb",
                      "Display-encoded sRGB, as photos are.",
                      "sdr-video",
                      { kDecode, to },
                      { from, kEncode } }) +
        color_space({ "srisp camera RGB",
                      "camera_rgb, srisp_camera_rgb",
                      "Linear camera RGB of the reference, the RAW file SRISP_REFERENCE.",
                      "scene-linear",
                      { kProcess, kDecode, to },
                      { from, kEncode, kUnprocess } }) +
        color_space({ "srisp process",
                      "srisp_process",
                      "The picture of a RAW-like image that the host takes for linear sRGB.",
                      "sdr-video",
                      { kUnprocess, to },
                      { from, kProcess } }) +
        color_space({ "srisp scene linear",
                      "srisp_scene_linear",
                      "What the reference's camera would have recorded, developed, with sRGB "
                      "primaries. Converting a photo to this space unprocesses and develops it.",
                      "scene-linear",
                      { to_aces, kUndevelop, kProcess, kDecode, to },
                      { from, kEncode, kUnprocess, kDevelop, from_aces } }) +
        color_space({ "srisp ACEScg",
                      "srisp_acescg",
                      "The same with the primaries of ACEScg.",
                      "scene-linear",
                      { kFromAcescg, kUndevelop, kProcess, kDecode, to },
                      { from, kEncode, kUnprocess, kDevelop, kToAcescg } }) +
        color_space({ "srisp photo",
                      "srisp_photo",
                      "A photo as the scene that the reference's camera would have seen; read in "
                      "this space, it is developed into the working space.",
                      "sdr-video",
                      { kUnprocess, kDevelop, from_aces, to },
                      { from, to_aces, kUndevelop, kProcess } });
    return { lines_of(looks), lines_of(spaces) };
}

} // namespace srisp::tool
