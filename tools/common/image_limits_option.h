// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace srisp::tool {

/// --max-megapixels N: the same as SRISP_MAX_MEGAPIXELS=N in the environment of this process and of those that it
/// starts.
void describe_image_limits(CLI::App& app);

/// The same for tools that read their words themselves. Throws Failure: no whole number from 1 to 1,000,000.
void set_max_megapixels(const std::string& text);

} // namespace srisp::tool
