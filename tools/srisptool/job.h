// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "command_line.h"

namespace srisp::tool {

/// A JSON file for the plugin, in the temporary folder: a recipe (`<n>.srisp`, with the path of the image), or a job
/// (`<n>.json`): pixels come by hand-over, or from the files of a sequence (`<n>.<frame>.srisp`, of which those that
/// are on disk say no more than that they are there).
struct JobFile {
    std::string name;
    nlohmann::json content;
};

/// What one of our commands asks for. What it names is looked up before oiiotool starts, so that a slip costs no work
/// and touches no output; each failure says the command and the name as typed. Paths come out absolute: job files lie
/// in another folder. References: the path of a file or folder, or an array of paths and globs.
nlohmann::json job_of(const Step& step);

} // namespace srisp::tool
