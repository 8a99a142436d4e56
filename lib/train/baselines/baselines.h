// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "train/network/layers.h"
#include "train/network/unprocessor.h"

namespace srisp::train {

/// The bar that a method must clear: x^2.2 times one gain per channel that gives it the reference's channel means
/// [method 4]. Learns nothing. Its choice: `gamma` 2.2 and, as `white_balance`, the gains of the forward pass.
class GainMatch : public Unprocessor {
public:
    torch::Tensor reverse(const torch::Tensor& source, const torch::Tensor& reference,
                          ChosenParameters* choice = nullptr) override;
    torch::Tensor apply_reverse(const torch::Tensor& image, const ChosenParameters& choice) override;
    torch::Tensor process(const torch::Tensor& raw, const ChosenParameters& choice) override;
    std::vector<torch::Tensor> dictionary_parameters() override { return {}; }
};

/// Unprocessing with random parameters that know neither photo nor reference (Brooks et al. 2019); learns nothing. Its
/// choice: `white_balance` is white balance and gain in one, `gain` is 1.
class Upi : public Unprocessor {
public:
    explicit Upi(std::uint64_t seed) : m_seed(seed) {}

    /// Every image that comes gets the next parameters of the seed.
    torch::Tensor reverse(const torch::Tensor& source, const torch::Tensor& reference,
                          ChosenParameters* choice = nullptr) override;
    torch::Tensor apply_reverse(const torch::Tensor& image, const ChosenParameters& choice) override;
    torch::Tensor process(const torch::Tensor& raw, const ChosenParameters& choice) override;
    std::vector<torch::Tensor> dictionary_parameters() override { return {}; }

private:
    ChosenParameters next_choice(std::int64_t images);

    std::uint64_t m_seed, m_images_seen = 0;
};

/// A plain U-Net from photo to RAW that looks at no reference, as the baseline of the AIM 2022 reversed-ISP challenge
/// (Conde et al. 2022) without its mosaicing: four levels of two 3×3 convolutions each, `channels` at full size and
/// twice as many on every level below. It ends on a sigmoid, which keeps results in [0, 1] and gradients alive.
class UNet : public Unprocessor {
public:
    UNet(int channels, std::uint64_t seed);

    torch::Tensor reverse(const torch::Tensor& source, const torch::Tensor& reference,
                          ChosenParameters* choice = nullptr) override;
    /// The choice plays no part.
    torch::Tensor apply_reverse(const torch::Tensor& image, const ChosenParameters& choice) override;
    /// It has no forward pass: an undefined tensor.
    torch::Tensor process(const torch::Tensor& raw, const ChosenParameters& choice) override;
    std::vector<torch::Tensor> dictionary_parameters() override { return {}; }

private:
    using Layers = std::vector<std::shared_ptr<Layer>>;
    Layers add_pair(const std::string& name, std::int64_t inputs, std::int64_t outputs, InitialWeights& initial);

    std::vector<Layers> m_down, m_up;
    std::shared_ptr<Layer> m_last;
};

} // namespace srisp::train
