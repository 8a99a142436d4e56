// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "unprocessor.h"

namespace srisp::train {

/// ½ − sin(asin(1 − 2v)/3), the inverse of the tone curve 3v² − 2v³; v in [0, 1].
torch::Tensor inverse_smoothstep(const torch::Tensor& image);

/// Unprocessing with random parameters that know neither photo nor reference (Brooks et al. 2019); learns nothing. Its
/// choice: `white_balance` is white balance and gain in one, `gain` is 1.
class Upi : public Unprocessor {
public:
    explicit Upi(std::uint64_t seed) : m_seed(seed) {}

    /// Every image that comes gets the next parameters of the seed.
    torch::Tensor reverse(const torch::Tensor& source, const torch::Tensor& reference,
                          Choice* choice = nullptr) override;
    torch::Tensor apply_reverse(const torch::Tensor& image, const Choice& choice) override;
    torch::Tensor process(const torch::Tensor& raw, const Choice& choice) override;
    std::vector<torch::Tensor> dictionary_parameters() override { return {}; }

private:
    Choice next_choice(std::int64_t images);

    std::uint64_t m_seed, m_images_seen = 0;
};

} // namespace srisp::train
