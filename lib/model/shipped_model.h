// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>

namespace srisp {

/// Whether a file that find_model_file found under a name is what ships under that name, where it lies in the installed
/// folder; others, and those that are named by path, are the user's own. The error gives both hashes.
Status check_shipped_model(const std::string& name_or_path, const std::string& path, const std::string& bytes);

} // namespace srisp
