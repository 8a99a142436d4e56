// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "feature_encoder.h"

namespace srisp::train {

enum class Selection {
    dynamic,      ///< softmax(H · (P · g_xr + g_i)) [P 3.1]
    intermediate, ///< softmax(H · g_i): the images' own features play no part
    fixed         ///< softmax(bias of H): the same for all images
};

/// Chooses the weights of one block's dictionaries (tone: one per layer). Its parameters are named as in the model
/// file; in the simpler selections those that play no part are absent.
class BlockSelector : public torch::nn::Module {
public:
    BlockSelector(Selection selection, int input_channels, int dictionaries, int atoms, InitialWeights& initial);

    /// Weights [N, atoms] of each dictionary for N images. `fused`: g_xr, [N, 128]; `input` makes the block's encoder
    /// input and is not called where images play no part.
    std::vector<torch::Tensor> weights(std::int64_t images, const torch::Tensor& fused,
                                       const std::function<torch::Tensor()>& input) const;

    /// What a fixed selection learns.
    std::vector<torch::Tensor> fixed_parameters() const;

private:
    Selection m_selection;
    std::shared_ptr<FeatureEncoder> m_encoder;
    std::vector<std::shared_ptr<Layer>> m_project, m_head; ///< a fixed selection's heads have no weight
};

} // namespace srisp::train
