// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "train/network/unprocessor.h"
#include "train/tensors/color.h"

namespace srisp::train {

// The blocks of the pipeline as LibTorch sees them [method 1]; lib/kernels/pointwise.h has the library's own. Images
// are [N, 3, H, W], or [N, K, 3, H, W] where each image has K candidates. Everything can be differentiated.

/// v^exponent where 1e-8 is the floor; exponent [N].
torch::Tensor power(const torch::Tensor& image, const torch::Tensor& exponent);
/// v^γ for the K atoms of a dictionary, γ: [K].
torch::Tensor power_candidates(const torch::Tensor& image, const torch::Tensor& gamma);

/// clamp01(M v), M: [N, 3, 3].
torch::Tensor color_transform(const torch::Tensor& image, const torch::Tensor& matrix);
/// clamp01(M v) for K matrices [K, 3, 3].
torch::Tensor color_candidates(const torch::Tensor& image, const torch::Tensor& matrices);

/// Highlight-preserving inverse gain, unclamped (Brooks et al. 2019); gains [N, 1] or [N, 3].
torch::Tensor inverse_gain(const torch::Tensor& image, const torch::Tensor& gains);
/// The same for K candidates; gains [N, K, 1] or [N, K, 3].
torch::Tensor inverse_gain_candidates(const torch::Tensor& image, const torch::Tensor& gains);
/// Gain < 1 after the white balance, which rebuilds clipped highlights (lib/kernels/pointwise.h); gain [N, 1, 1, 1].
torch::Tensor rebuilt_highlights(const torch::Tensor& balanced, const torch::Tensor& gain);

/// replication_pad2d(relu(x), 1) of [N, C, H, W], in one pass over memory on the CPU: a third of the time of the two,
/// which take as long as a fifth of a tone map's convolutions.
torch::Tensor relu_with_border(const torch::Tensor& x);

/// clamp01(v + φ(v)) with kernels of its own for every image: image [N, 3, H, W]; per layer weight [N, O, I, k, k] and
/// bias [N, O]; ReLU between; each layer replicates the edge of its input [P 3.2, method 1].
torch::Tensor apply_tone_map(const torch::Tensor& image, const std::vector<torch::Tensor>& weight,
                             const std::vector<torch::Tensor>& bias);

/// max(v, 1e-5)^(1/2.2) − 0.3, which brings linear images to a like scale for the encoders.
torch::Tensor perceptual(const torch::Tensor& linear);

/// The reverse pass with a given choice: tone map (where it has one), gamma, colour, white balance, gain, clamp.
torch::Tensor reverse_pipeline(const torch::Tensor& source, const ChosenParameters& choice);

/// The forward pass with the same choice; `white_stays_white`: gains below 1 rebuild clipped highlights.
torch::Tensor forward_pipeline(const torch::Tensor& raw, const ChosenParameters& choice, bool white_stays_white);

} // namespace srisp::train
