// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <srisp/expected.h>

#include "pack/training_pack.h"
#include "raw_picture.h"

namespace srisp::tool {

/// The whole RAW images of a pack that are not for training.
std::vector<std::size_t> packed_test_images(const TrainingPack& pack);

/// One of them, with an exposure that is drawn for it, as the trainer's tests draw it: packs may have lost the image's
/// own. `as_exposed_by_eye`: in the range of somebody who looks at the picture. Its matrix, where it is not known, is
/// the mean of other cameras'. Errors: those of the pack.
Expected<RawPicture> packed_raw_picture(const TrainingPack& pack, std::size_t entry, bool as_exposed_by_eye,
                                        std::uint64_t seed);

} // namespace srisp::tool
