// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "inputs.h"
#include "pack/training_pack_index.h"
#include "pack_images.h"

namespace srisp::tool {

/// What a run of srisppack made.
struct Summary {
    std::string pack;
    std::optional<PartReport> photos, raws;
    std::optional<PackCamerasIndex> cameras;
    int not_in_manifest = 0, not_open = 0, other_files = 0;
};

/// For people: counts, and how many images are under which licence.
std::string summary_text(const Summary& summary);

/// The same for programs.
std::string summary_json(const Summary& summary);

} // namespace srisp::tool
