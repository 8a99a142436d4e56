// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "manifest.h"
#include "pack_task.h"

namespace srisp::tool {

/// Reads a RAW file (or a linear image) as srisptool reads references, and squashes it and its crops; white balance and
/// colour matrix as the file states them. Crops come from the thumbnail of 256 × 256, so `settings.size` is at most
/// that.
PackTask raw_task(const std::string& path, const std::string& name, const Provenance& provenance,
                  const CropSettings& settings);

} // namespace srisp::tool
