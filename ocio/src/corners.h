// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace srisp {

/// Points of sampled curves per 0.1 of what they look up. GPUs interpolate textures with 8 bits between two points.
constexpr int kPointsPerTenth = 64;

/// A monotonic curve of straight lines over [0,1], and its inverse. Corners lie on points of the sampled curve.
struct Corners {
    std::vector<double> from, to;

    static double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at)
    {
        std::size_t i = 1;
        while (i + 1 < x.size() && at > x[i])
            ++i;
        return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
    }
    double operator()(double at) const { return interpolate(from, to, at); }
    double inverse(double at) const { return interpolate(to, from, at); }
};

} // namespace srisp
