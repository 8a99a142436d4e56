// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bake_errors.h"
#include "bake_options.h"

namespace srisp::tool {

/// A file that was written, and how far off it is.
struct BakeReport {
    OutputName name;
    std::size_t bytes;
    BakeErrors errors;
    std::string sentence; ///< the errors in words, as in the file's description
};

/// What was baked, and from what.
struct BakeSummary {
    std::string photo; ///< what errors were measured on; empty where there was none
    std::vector<BakeReport> files;
    std::vector<std::string> notes; ///< what was assumed or changed in photo, reference and choice
};

/// The errors in words.
std::string error_sentence(const BakeErrors& errors, const BakeChoice& choice);

/// What is printed of a bake: files, sizes, errors, and what to set in the host.
std::string summary_text(const BakeSummary& summary);

/// The same as a JSON object.
std::string summary_json(const BakeSummary& summary);

/// What hosts will stumble over in the name that SRISP_REFERENCE gets; "" if nothing.
std::string name_warning(const std::string& reference);

} // namespace srisp::tool
