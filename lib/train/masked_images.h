// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "area_resize.h"

namespace srisp::train {

/// Public RAW sets blacken their colour charts: exact zeros in all channels, which no scene has and every statistic
/// sees. Finds the largest part of an image [3, S, S] of which at most 0.5 % is zero, on a grid of S / 16; nothing
/// where that is less than 60 % of the image.
std::optional<Window> unmasked_window(const torch::Tensor& raw);

} // namespace srisp::train
