// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace srisp::tool {

// What a command names is looked up before oiiotool starts, so that a slip costs no work and touches no output. Paths
// come out absolute: job files lie in another folder. Each fails with the command and the name as typed.

/// A reference for a job: one path, or an array of paths for a list (`a.dng;b.dng`) or a glob. A name that exists is
/// itself, whatever characters it has.
nlohmann::json reference_input(const std::string& command, const std::string& text);

/// A file that must exist.
std::string file_input(const std::string& command, const std::string& what, const std::string& path);

/// A model: a name that is found, or the path of a file that exists.
std::string model_input(const std::string& command, const std::string& name_or_path);

/// The path of a file to be written, whose folder must exist.
std::string output_path(const std::string& command, const std::string& path);

} // namespace srisp::tool
