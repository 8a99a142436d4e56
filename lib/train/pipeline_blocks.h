// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "torch_api.h"

namespace srisp::train {

// The blocks of the pipeline as LibTorch sees them [method 1]; lib/src/pointwise.h has the library's own. Images are
// [N, 3, H, W], or [N, K, 3, H, W] where each image has K candidates. Everything can be differentiated.

/// v^exponent where 1e-8 is the floor; exponent [N].
torch::Tensor power(const torch::Tensor& image, const torch::Tensor& exponent);
/// v^γ for the K atoms of a dictionary, γ: [K].
torch::Tensor power_candidates(const torch::Tensor& image, const torch::Tensor& gamma);

/// The inverses of matrices [..., 3, 3].
torch::Tensor inverse3x3(const torch::Tensor& matrix);
/// Each row divided by its signed sum.
torch::Tensor row_normalized(const torch::Tensor& matrix);
/// clamp01(M v), M: [N, 3, 3].
torch::Tensor color_transform(const torch::Tensor& image, const torch::Tensor& matrix);
/// clamp01(M v) for K matrices [K, 3, 3].
torch::Tensor color_candidates(const torch::Tensor& image, const torch::Tensor& matrices);

/// Highlight-preserving inverse gain, unclamped (Brooks et al. 2019); gains [N, 1] or [N, 3].
torch::Tensor inverse_gain(const torch::Tensor& image, const torch::Tensor& gains);
/// The same for K candidates; gains [N, K, 1] or [N, K, 3].
torch::Tensor inverse_gain_candidates(const torch::Tensor& image, const torch::Tensor& gains);
/// Gain < 1 after the white balance, which rebuilds clipped highlights (lib/src/pointwise.h); gain [N, 1, 1, 1].
torch::Tensor rebuilt_highlights(const torch::Tensor& balanced, const torch::Tensor& gain);

/// max(v, 1e-5)^(1/2.2) − 0.3, which brings linear images to a like scale for the encoders.
torch::Tensor perceptual(const torch::Tensor& linear);

} // namespace srisp::train
