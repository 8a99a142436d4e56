// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/samples/data_settings.h"
#include "train/tensors/resize.h"

namespace srisp::train {

/// What a sample shows: where the reference comes from, the parts of the scenes, how they are turned.
struct SampleGeometry {
    enum class Reference { other_scene, half_split, other_crop } kind = Reference::other_crop;
    Window source, reference;                    ///< the truth is the source's part of the RAW image
    int source_detail = 0, reference_detail = 0; ///< enlarged from this many px; 0: as it is
    int quarter_turns = 0;
    bool mirrored = false;
};

SampleGeometry draw_geometry(const DataSettings& settings, Random random);

/// A part of a scene with sides of `smallest_crop` to 1, drawn apart.
Window draw_crop(const DataSettings& settings, Random& random);

/// Crops each scene [N, 3, H, W] to its window, loses detail where it is not 0, turns and mirrors: [N, 3, size, size].
torch::Tensor cut(const torch::Tensor& scenes, const std::vector<SampleGeometry>& geometry,
                  Window SampleGeometry::*window, int SampleGeometry::*detail, int size);

} // namespace srisp::train
