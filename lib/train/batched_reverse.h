// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "unprocessor.h"

namespace srisp::train {

/// The reverse pass of any number of images, batch by batch, without gradients, on the device where the method's
/// parameters are; the result is on the CPU. `thumbnail_px`: side of the squares on which parameters are chosen; 0: the
/// images as they are.
torch::Tensor batched_reverse(Unprocessor& method, const torch::Tensor& source, const torch::Tensor& reference,
                              int thumbnail_px);

} // namespace srisp::train
