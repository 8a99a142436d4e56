// SPDX-License-Identifier: Apache-2.0
#include "bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"

namespace srisp::tool {

double pooled(const PerFile& files, const FileCounts& counts)
{
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < files.size(); ++i) {
        sum += counts[i] * files[i].sum;
        weight += counts[i] * files[i].weight;
    }
    return sum / weight;
}

Bootstrap::Bootstrap(std::size_t files, std::uint64_t seed) : m_files(files)
{
    if (files < 2)
        return;
    m_draws.assign(kResamples, FileCounts(files));
    for (std::size_t k = 0; k < m_draws.size(); ++k) {
        Random random(seed, k);
        for (std::size_t i = 0; i < files; ++i)
            ++m_draws[k][std::size_t(random.integer(std::int64_t(files)))];
    }
}

Interval Bootstrap::interval_of(double value, std::vector<double> draws)
{
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    draws.erase(std::remove_if(draws.begin(), draws.end(), [](double v) { return !std::isfinite(v); }), draws.end());
    if (draws.empty() || !std::isfinite(value))
        return { std::isfinite(value) ? value : kNone, kNone, kNone };
    std::sort(draws.begin(), draws.end());
    const auto at = [&](double share) { return draws[std::size_t(std::lround(share * double(draws.size() - 1)))]; };
    return { value, at(0.025), at(0.975) };
}

} // namespace srisp::tool
