// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "feature_encoder.h"
#include "unprocessor.h"

namespace srisp::train {

/// A plain U-Net from photo to RAW that looks at no reference, as the baseline of the AIM 2022 reversed-ISP challenge
/// (Conde et al. 2022) without its mosaicing: four levels of two 3×3 convolutions each, `channels` at full size and
/// twice as many on every level below. It ends on a sigmoid, which keeps results in [0, 1] and gradients alive.
class UNet : public Unprocessor {
public:
    UNet(int channels, std::uint64_t seed);

    torch::Tensor reverse(const torch::Tensor& source, const torch::Tensor& reference,
                          Choice* choice = nullptr) override;
    /// The choice plays no part.
    torch::Tensor apply_reverse(const torch::Tensor& image, const Choice& choice) override;
    /// It has no forward pass: an undefined tensor.
    torch::Tensor process(const torch::Tensor& raw, const Choice& choice) override;
    std::vector<torch::Tensor> dictionary_parameters() override { return {}; }

private:
    using Layers = std::vector<std::shared_ptr<Layer>>;
    Layers add_pair(const std::string& name, std::int64_t inputs, std::int64_t outputs, InitialWeights& initial);

    std::vector<Layers> m_down, m_up;
    std::shared_ptr<Layer> m_last;
};

} // namespace srisp::train
