// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace srisp::tool {

/// What was added to a config.
struct FragmentReport {
    std::string config;              ///< the file that was written; empty: all was there already
    std::string neutral_folder;      ///< where the neutral bakes were put
    std::string linear_srgb;         ///< how linear sRGB was found
    bool environment_section = true; ///< false: there is none, so SRISP_REFERENCE must be set in the environment
    bool search_path = true;         ///< false: there was none, so it was set to the config's own folder
};

/// Adds our looks and colour spaces to the OpenColorIO config `path`, and writes it to `output` (empty: to itself). The
/// text is extended, not written anew; an empty search path becomes ".". Checked before anything is written: the result
/// loads and validates, everything that was there is there as it was, and what is new gives processors. `linear_srgb`:
/// name of that colour space, or empty. Throws Failure.
FragmentReport add_fragment(const std::string& path, const std::string& output, const std::string& linear_srgb);

/// What is printed of it.
std::string fragment_text(const FragmentReport& report);

} // namespace srisp::tool
