// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pack/training_pack_index.h"

namespace srisp::tool {

/// What became of the images of one part.
struct PartReport {
    int size = 0, scenes = 0, images = 0;        ///< images: with crops
    int open = 0, validation = 0, enlarged = 0;  ///< scenes
    std::map<std::string, int> licences, groups; ///< scenes of each
    std::map<std::string, int> left_out;         ///< by reason
    std::vector<std::string> failures;           ///< messages of images that cannot be read
};

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
