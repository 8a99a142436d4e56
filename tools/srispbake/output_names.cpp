// SPDX-License-Identifier: Apache-2.0
#include "output_names.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "../common/failure.h"
#include "ocio/src/clf_text.h"

namespace srisp::tool {

namespace fs = std::filesystem;

namespace {

const char kReferenceLine[] = "Reference: ";

bool ends_with(const std::string& text, const std::string& end)
{
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Where the pair of a reference is named after; the folder can be written to.
std::string stem_of_reference(const std::string& reference)
{
    const fs::path path(reference), folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (access(folder.c_str(), W_OK) == 0)
        return reference;
    const char* variable = std::getenv("SRISP_BAKE_PATH");
    if (!variable || !*variable)
        fail("folder '" + folder.string() +
             "' cannot be written to; set SRISP_BAKE_PATH to a folder for bakes, or give -o NAME");
    if (access(variable, W_OK) != 0)
        fail("neither folder '" + folder.string() + "' nor '" + variable +
             "' (SRISP_BAKE_PATH) can be written to; give -o NAME");
    return (fs::path(variable) / path.filename()).string();
}

} // namespace

bool is_single_file(const std::string& output)
{
    return ends_with(output, ".clf") || ends_with(output, ".cube");
}

const char* direction_name(Direction direction)
{
    return direction == Direction::reverse ? "unprocess" : "process";
}

std::vector<OutputName> output_names(const std::string& reference, const std::string& output,
                                     const std::string& direction, bool cube)
{
    if (is_single_file(output))
        return { { output, direction == "process" ? Direction::forward : Direction::reverse,
                   ends_with(output, ".cube") } };
    const std::string stem = (output.empty() ? stem_of_reference(reference) : output) + ".";
    std::vector<OutputName> names;
    for (const bool as_cube : { false, true })
        for (const Direction each : { Direction::reverse, Direction::forward })
            if (!as_cube || cube)
                names.push_back({ stem + direction_name(each) + (as_cube ? ".cube" : ".clf"), each, as_cube });
    return names;
}

std::string reference_line(const std::string& reference)
{
    return kReferenceLine + reference;
}

void refuse_bake_of_another(const std::string& path, const std::string& reference)
{
    std::ifstream file(path, std::ios::binary);
    std::string head(16384, '\0');
    file.read(head.data(), std::streamsize(head.size()));
    head.resize(std::size_t(file.gcount()));
    const std::size_t start = head.find(kReferenceLine);
    if (start == std::string::npos)
        return;
    const std::string line = head.substr(start, head.find_first_of("<\n", start) - start);
    if (line != reference_line(reference) && line != clf_escaped(reference_line(reference)))
        fail("'" + path + "' is the bake of another reference (" + line.substr(sizeof kReferenceLine - 1) +
             "); remove it, or give -o NAME");
}

} // namespace srisp::tool
