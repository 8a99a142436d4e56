// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "command_line.h"

namespace srisp::tool {

/// A JSON file for the plugin, in the temporary folder: a job (`<n>.json`, pixels come by hand-over) or a recipe
/// (`<n>.srisp`, with the path of the image).
struct JobFile {
    std::string name;
    nlohmann::json content;
};

/// What one of our commands asks for, its modifiers and files checked.
nlohmann::json job_of(const Step& step);

} // namespace srisp::tool
