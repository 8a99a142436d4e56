// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/metrics.h>

namespace srisp::train {

/// How far the results of one method were from the truth, over any number of crops.
struct Measure {
    int crops = 0;
    double psnr_sum = 0; ///< dB
    AngularError angle;
    HighlightErrors highlights;
    double log_error_sum = 0, log_error_square_sum = 0; ///< of ln(mean green), result − truth

    void add(ImageView result, ImageView truth);
    Measure& operator+=(const Measure& other);

    double psnr() const;           ///< mean of the crops' dB
    double log_error_mean() const; ///< of the brightness: 0.1 is 10 % too bright
    double log_error_deviation() const;
};

} // namespace srisp::train
