// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bake.h"

namespace srisp::tool {

/// What is printed of a bake: files, sizes, errors, and what to set in the host.
std::string summary_text(const BakeSummary& summary);

/// The same as a JSON object.
std::string summary_json(const BakeSummary& summary);

/// What hosts will stumble over in the name that SRISP_REFERENCE gets; "" if nothing.
std::string name_warning(const std::string& reference);

} // namespace srisp::tool
