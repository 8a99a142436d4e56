// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "batch_options.h"

namespace srisp::tool {

/// What decides the bytes of a set's results, but photos, references and seeds, as JSON: options as they were typed,
/// the model's hash, parameters that were given. Throws Failure: there is no such model.
std::string settings_text(const MakingOptions& options);

/// Its hash, which the lines of a manifest name.
std::string settings_hash(const std::string& text);

/// Options with which a result that was made with such settings can be made again, by the parameters that its line
/// records. Throws Failure: they cannot be read; those of finish().
MakingOptions options_of_settings(const std::string& text);

} // namespace srisp::tool
