// SPDX-License-Identifier: Apache-2.0
#include "train/evaluation/measure.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace srisp::train {

void Measure::add(ImageView result, ImageView truth, std::optional<double> log_deviation)
{
    ++crops;
    psnr_sum += srisp::psnr(result, truth);
    angle += angular_error(result, truth);
    highlights += highlight_errors(result, truth);
    const double log_error = log_brightness(result) - log_brightness(truth);
    log_error_sum += log_error;
    log_error_square_sum += log_error * log_error;
    if (!log_deviation)
        return;
    deviations.push_back(std::exp(*log_deviation));
    errors_in_deviations.push_back(std::abs(log_error) / deviations.back());
}

Measure& Measure::operator+=(const Measure& other)
{
    crops += other.crops;
    psnr_sum += other.psnr_sum;
    angle += other.angle;
    highlights += other.highlights;
    log_error_sum += other.log_error_sum;
    log_error_square_sum += other.log_error_square_sum;
    errors_in_deviations.insert(errors_in_deviations.end(), other.errors_in_deviations.begin(),
                                other.errors_in_deviations.end());
    deviations.insert(deviations.end(), other.deviations.begin(), other.deviations.end());
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

double Measure::share_within(double limit) const
{
    const auto count = std::count_if(errors_in_deviations.begin(), errors_in_deviations.end(),
                                     [limit](double error) { return error <= limit; });
    return double(count) / double(errors_in_deviations.size());
}

double Measure::deviation_factor() const
{
    if (errors_in_deviations.empty())
        return std::nan("");
    std::vector<double> sorted = errors_in_deviations;
    const auto middle = sorted.begin() + std::lround(0.6827 * double(sorted.size() - 1));
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
}

double Measure::mean_deviation_ev() const
{
    return std::accumulate(deviations.begin(), deviations.end(), 0.0) / double(deviations.size()) / std::log(2.0);
}

} // namespace srisp::train
