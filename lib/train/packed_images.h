// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "pack/training_pack.h"
#include "torch_api.h"

namespace srisp::train {

/// One image of a pack as float32 [3, S, S] in [0, 1].
torch::Tensor packed_image(const PackedImages& images, std::size_t entry);

/// The entries that are whole photos or RAW images, not crops of those; the ones marked for validation or all.
std::vector<std::size_t> whole_images(const PackedImages& images, bool validation_only);

} // namespace srisp::train
