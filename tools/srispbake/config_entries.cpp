// SPDX-License-Identifier: Apache-2.0
#include "config_entries.h"

#include <cstdio>
#include <sstream>

namespace srisp::tool {

namespace {

const char kUnprocess[] = "!<FileTransform> {src: \"${SRISP_REFERENCE}.unprocess.clf\", interpolation: best}";
const char kProcess[] = "!<FileTransform> {src: \"${SRISP_REFERENCE}.process.clf\", interpolation: best}";
const char kDecode[] = "!<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: forward}";
const char kEncode[] = "!<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}";

std::string matrix_text(const std::array<double, 9>& m, const char* direction)
{
    std::string text = "!<MatrixTransform> {matrix: [";
    for (int row = 0; row < 3; ++row) {
        char numbers[120];
        std::snprintf(numbers, sizeof numbers, "%.10g, %.10g, %.10g, 0, ", m[row * 3], m[row * 3 + 1], m[row * 3 + 2]);
        text += numbers;
    }
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

const std::vector<AddedVariable> kAddedVariables = { { "SRISP_MODEL", "pointwise" },
                                                     { "SRISP_REFERENCE", "srisp_neutral" },
                                                     { "SRISP_SOURCE", "" } };
const std::vector<std::string> kAddedLooks = { "srisp unprocess", "srisp process" };
const std::vector<std::string> kAddedColorSpaces = { "srisp linear sRGB", "srisp sRGB", "srisp camera RGB",
                                                     "srisp process" };
const std::vector<std::string> kAddedAliases = { "srisp_linear_srgb", "srisp_srgb", "camera_rgb", "srisp_camera_rgb",
                                                 "srisp_process" };

ConfigEntries config_entries(const std::array<double, 9>& to_reference)
{
    const std::string to = matrix_text(to_reference, "forward"), from = matrix_text(to_reference, "inverse");
    const std::string looks =
        look("srisp unprocess", "srisp sRGB",
             "Photo to the camera RGB of the reference. Take sRGB as input and output space.", kUnprocess, kProcess) +
        look("srisp process", "srisp linear sRGB",
             "Camera RGB of the reference to the picture. Take linear sRGB as input and output space.", kProcess,
             kUnprocess);
    const std::string spaces = color_space({ "srisp linear sRGB",
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
                                             { from, kProcess } });
    return { lines_of(looks), lines_of(spaces) };
}

} // namespace srisp::tool
