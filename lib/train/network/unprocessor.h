// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "train/tensors/torch_api.h"

namespace srisp::train {

/// The parameters that were chosen for a batch of N images. Undefined tensors where a method has no such block.
struct ChosenParameters {
    torch::Tensor gamma;                          ///< [N]
    torch::Tensor color;                          ///< [N, 3, 3], C: camera RGB to linear sRGB, rows sum to 1
    torch::Tensor white_balance;                  ///< [N, 3], R, G, B, anchor included
    torch::Tensor gain;                           ///< [N], anchor included
    std::map<std::string, torch::Tensor> weights; ///< selection weights [N, K] by dictionary: "tone.0" … "gain"
    /// The mixed tone kernels of the four layers, [N, O, I, k, k] and [N, O].
    std::vector<torch::Tensor> tone_reverse_weight, tone_reverse_bias, tone_forward_weight, tone_forward_bias;
    torch::Tensor expected_means; ///< [N, 3], ln of the RAW's channel means as the anchor has them; may be undefined
    torch::Tensor log_deviation;  ///< [N], ln of the standard deviation of the error of ln brightness; may be undefined
    torch::Tensor base;           ///< [N, 3], the anchor's gains before the dictionaries
};

/// A method that unprocesses: SRISP, one of its ablations, a baseline. Images are [N, 3, H, W] float32: a source
/// display-encoded in [0, 1], a reference and results linear camera RGB in [0, 1]. Source and reference need not have
/// the same size. Parameters are chosen on the source as it is given: here the image is its own thumbnail.
class Unprocessor : public torch::nn::Module {
public:
    /// Reverse pass; fills `choice` where it is given.
    virtual torch::Tensor reverse(const torch::Tensor& source, const torch::Tensor& reference,
                                  ChosenParameters* choice = nullptr) = 0;

    /// Side of the squares on which parameters are chosen, px; 0: the images as they are.
    virtual int selection_size() const { return 0; }

    /// Reverse pass of `image` with a choice made elsewhere (on thumbnails).
    virtual torch::Tensor apply_reverse(const torch::Tensor& image, const ChosenParameters& choice) = 0;

    /// Forward pass (RAW to display) with the same choice; undefined where the method has none.
    virtual torch::Tensor process(const torch::Tensor& raw, const ChosenParameters& choice) = 0;

    /// Parameters that learn at the dictionaries' own rate; others learn at the common one.
    virtual std::vector<torch::Tensor> dictionary_parameters() = 0;

    /// Parameters that are fitted before the first step, and have no gradient in the passes.
    virtual std::vector<torch::Tensor> anchor_parameters() { return {}; }

    /// After every optimiser step: keeps parameters where they make sense (no gain below 1e-3, …).
    virtual void constrain() {}
};

/// The reverse pass of any number of images, batch by batch, without gradients, on the device where the method's
/// parameters are; the result is on the CPU. `thumbnail_px`: side of the squares on which parameters are chosen; 0: the
/// method's own. `log_deviations` gets those of all images, where the method knows them.
torch::Tensor batched_reverse(Unprocessor& method, const torch::Tensor& source, const torch::Tensor& reference,
                              int thumbnail_px, torch::Tensor* log_deviations = nullptr);

} // namespace srisp::train
