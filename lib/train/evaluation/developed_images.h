// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <srisp/expected.h>

#include "train/evaluation/test_scenes.h"

namespace srisp::train {

/// Real RAW images and what RAW converters made of them.
struct DevelopedImages {
    TestScenes scenes; ///< set "developed"; white balances and matrices are left out
    std::vector<std::pair<std::string, torch::Tensor>> photos; ///< by converter: [N, 3, S, S], display-encoded
};

/// A safetensors file that tests/bench/develop_raws.py wrote: tensors `raw` and `photo:NAME` [N, 3, S, S] with values
/// in [0, 1]; metadata `format` srisp-developed-1 and `cameras`, a JSON array of N names. Errors: what
/// is missing or has another shape.
Expected<DevelopedImages> read_developed_images(const std::string& path);

} // namespace srisp::train
