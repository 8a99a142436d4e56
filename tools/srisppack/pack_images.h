// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/progress.h"
#include "pack/training_pack_writer.h"
#include "pack_task.h"

namespace srisp::tool {

/// What became of the images of one part.
struct PartReport {
    int size = 0, scenes = 0, images = 0;        ///< images: with crops
    int open = 0, validation = 0, enlarged = 0;  ///< scenes
    std::map<std::string, int> licences, groups; ///< scenes of each
    std::map<std::string, int> left_out;         ///< by reason
    std::vector<std::string> failures;           ///< messages of images that cannot be read
};

/// Counts what is done over all parts.
struct Progress {
    ProgressMeter& meter;
    std::int64_t done = 0;
};

/// Runs the tasks on all threads and writes their images in the order of the tasks, a batch at a time: memory does not
/// grow with their number. Throws Interrupted; fails when the disk does.
PartReport pack_images(const std::vector<PackTask>& tasks, PackImagesWriter& writer, const CropSettings& settings,
                       int threads, Progress& progress);

} // namespace srisp::tool
