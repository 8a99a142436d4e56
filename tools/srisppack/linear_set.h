// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "manifest.h"
#include "pack_tasks.h"

namespace srisp::tool {

/// Sets of linear images in one file, format "srisp-thumbnails-1" (docs/training.md): safetensors with `raw` [N,
/// height, width, 3] (F16 or F32, black subtracted, in [0,1]), and if known `illuminant` [N, 3] (F32, camera RGB of the
/// light) and `validation` [N] (U8); metadata `camera`, `names` (N words), `dataset`, `licence`.

/// The shorter side of the images; 0 if the file can't be read (its task says why).
int linear_set_size(const std::string& path);

/// One task per image; a single one that fails, if the file can't be read. Where a part was masked with zeros (colour
/// charts), the largest part without is taken; what is less than half of the image is left out.
std::vector<PackTask> linear_set_tasks(const std::string& path, const std::string& name, const Provenance& provenance,
                                       const CropSettings& settings);

} // namespace srisp::tool
