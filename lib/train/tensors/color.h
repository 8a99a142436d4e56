// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "train/tensors/random.h"

namespace srisp::train {

/// The inverses of matrices [..., 3, 3].
torch::Tensor inverse3x3(const torch::Tensor& matrix);
/// Each row divided by its signed sum.
torch::Tensor row_normalized(const torch::Tensor& matrix);
/// One matrix [N, 3, 3] for the colours of each image [N, 3, H, W]; on the images' device.
inline torch::Tensor transform_colors(const torch::Tensor& matrices, const torch::Tensor& images)
{
    return torch::bmm(matrices.to(images.device()), images.flatten(2)).view_as(images);
}

/// Luminance of linear sRGB (Rec. 709), [N, 3, H, W] → [N, 1, H, W].
torch::Tensor luminance(const torch::Tensor& rgb);

/// Quantiles, ascending, of each row of [N, M]: the values at ranks round(q (M − 1)), not interpolated; [N] each.
std::vector<torch::Tensor> row_quantiles(const torch::Tensor& rows, const std::vector<double>& quantiles);
torch::Tensor row_quantile(const torch::Tensor& rows, double q);

/// v^exponent for v ≥ 0 and exponents > 0, within 1e-6 of its value: half the time of LibTorch's pow, which is right to
/// the last bit.
inline torch::Tensor fast_power(const torch::Tensor& v, const torch::Tensor& exponent)
{
    return v.log().mul_(exponent).exp_();
}

/// Part of the way from v to 3v² − 2v³.
inline torch::Tensor smoothstep(const torch::Tensor& v, const torch::Tensor& part)
{
    return v.mul(-2).add_(3).mul_(v).sub_(1).mul_(part).add_(1).mul_(v);
}

/// sRGB's encoding of linear values in [0, 1]. (IEC 61966-2-1)
torch::Tensor srgb_encoded(const torch::Tensor& linear);

/// Values in [0, 1] rounded to 8 bits.
torch::Tensor eight_bit(const torch::Tensor& v);

/// ½ − sin(asin(1 − 2v)/3), the inverse of the curve 3v² − 2v³; v is clamped to [0, 1].
torch::Tensor inverse_smoothstep(const torch::Tensor& v);

/// The four cameras of the Darmstadt Noise Dataset as UPI uses them (Brooks et al. 2019): linear sRGB → camera RGB,
/// rows sum to 1, [4, 3, 3].
torch::Tensor dnd_rgb_to_camera();

/// White-balanced camera RGB → linear sRGB of `count` of them for each image, in random order, [N, count, 3, 3]: what
/// pictures may be rendered with where no cameras are measured.
torch::Tensor dnd_color_matrices(int count, Randoms& randoms);

} // namespace srisp::train
