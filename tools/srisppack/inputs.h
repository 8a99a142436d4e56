// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "manifest.h"
#include "pack_options.h"

namespace srisp::tool {

/// An image file to be packed.
struct ImageInput {
    std::string path;
    std::string name; ///< path within the folder that was given
    Provenance provenance;
};

/// What was found in the inputs, in the order given, sorted by name within each.
struct Inputs {
    std::vector<ImageInput> photos;
    std::vector<ImageInput> raws;          ///< RAW files
    std::vector<ImageInput> sets;          ///< .safetensors
    std::string cameras;                   ///< folder; "" for none
    int other_files = 0;                   ///< nothing that can be packed
    int not_in_manifest = 0, not_open = 0; ///< left out
};

/// Looks through folders, and judges files by their first bytes. Fails: an input that does not exist, two folders of
/// cameras, nothing to pack.
Inputs find_inputs(const PackOptions& options);

} // namespace srisp::tool
