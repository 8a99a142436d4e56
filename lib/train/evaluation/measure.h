// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <srisp/image.h>
#include <srisp/metrics.h>

#include "train/tensors/torch_api.h"

namespace srisp::train {

/// Views of images [N, 3, H, W] for the functions of the library, which take interleaved channels.
class InterleavedImages {
public:
    explicit InterleavedImages(const torch::Tensor& images)
        : m_values(images.to(torch::kCPU, torch::kFloat32).permute({ 0, 2, 3, 1 }).contiguous())
    {
    }

    ImageView operator[](std::int64_t n) const
    {
        const auto height = static_cast<int>(m_values.size(1)), width = static_cast<int>(m_values.size(2));
        return { m_values.data_ptr<float>() + n * height * width * 3, width, height, 3, std::ptrdiff_t(3) * width };
    }

private:
    torch::Tensor m_values;
};

/// How far the results of one method were from the truth, over any number of crops.
struct Measure {
    int crops = 0;
    double psnr_sum = 0; ///< dB
    AngularError angle;
    HighlightErrors highlights;
    double log_error_sum = 0, log_error_square_sum = 0; ///< of ln brightness, result − truth
    /// Of the crops whose method says how sure it is: the sizes of these errors in its standard deviations, and those
    /// deviations.
    std::vector<double> errors_in_deviations, deviations;

    /// `log_deviation`: ln of the standard deviation of ln brightness that the method tells.
    void add(ImageView result, ImageView truth, std::optional<double> log_deviation = {});
    Measure& operator+=(const Measure& other);

    double psnr() const;           ///< mean of the crops' dB
    double log_error_mean() const; ///< of the brightness: 0.1 is 10 % too bright
    double log_error_deviation() const;
    /// Share of the errors that are at most this many of the deviations told; NaN where none were.
    double share_within(double deviations) const;
    /// What deviations would have to be multiplied by for 68.27 % of the errors to lie within one; NaN where there are
    /// none.
    double deviation_factor() const;
    /// Mean of the deviations told, in EV; NaN where there are none.
    double mean_deviation_ev() const;
};

} // namespace srisp::train
