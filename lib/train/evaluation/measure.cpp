// SPDX-License-Identifier: Apache-2.0
#include "train/evaluation/measure.h"

#include <algorithm>
#include <cmath>

namespace srisp::train {

/// ln of the mean green value, which is kept from 0.
static double log_mean_green(ImageView image)
{
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            sum += image.pixel(x, y)[1];
    return std::log(std::max(sum / (double(image.width) * image.height), 1e-5));
}

void Measure::add(ImageView result, ImageView truth)
{
    ++crops;
    psnr_sum += srisp::psnr(result, truth);
    angle += angular_error(result, truth);
    highlights += highlight_errors(result, truth);
    const double log_error = log_mean_green(result) - log_mean_green(truth);
    log_error_sum += log_error;
    log_error_square_sum += log_error * log_error;
}

Measure& Measure::operator+=(const Measure& other)
{
    crops += other.crops;
    psnr_sum += other.psnr_sum;
    angle += other.angle;
    highlights += other.highlights;
    log_error_sum += other.log_error_sum;
    log_error_square_sum += other.log_error_square_sum;
    return *this;
}

double Measure::psnr() const
{
    return psnr_sum / crops;
}

double Measure::log_error_mean() const
{
    return log_error_sum / crops;
}

double Measure::log_error_deviation() const
{
    const double mean = log_error_mean();
    return std::sqrt(std::max(0.0, log_error_square_sum / crops - mean * mean));
}

} // namespace srisp::train
