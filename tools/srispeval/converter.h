// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include <srisp/expected.h>

namespace srisp::tool {

/// Whether a program is found in PATH.
bool is_installed(const std::string& program);

/// Lets a RAW converter (dcraw, rawtherapee-cli, darktable-cli) develop a file as it does when nothing is asked for;
/// the photo is in `folder`, which is this call's own: its path. A program that takes longer than ten minutes, or a
/// signal to this one, ends it. Errors, without the file's name: how the program ended.
Expected<std::string> convert_raw(const std::string& program, const std::string& raw,
                                  const std::filesystem::path& folder);

} // namespace srisp::tool
