// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "torch_api.h"

namespace srisp::train {

/// v^exponent for v ≥ 0 and exponents > 0, within 1e-6 of its value: half the time of LibTorch's pow, which is right to
/// the last bit.
inline torch::Tensor power(const torch::Tensor& v, const torch::Tensor& exponent)
{
    return v.log().mul_(exponent).exp_();
}

/// Part of the way from v to 3v² − 2v³.
inline torch::Tensor smoothstep(const torch::Tensor& v, const torch::Tensor& part)
{
    return v.mul(-2).add_(3).mul_(v).sub_(1).mul_(part).add_(1).mul_(v);
}

} // namespace srisp::train
