// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scores.h"

namespace srisp::tool {

/// How often each file counts.
using FileCounts = std::vector<std::uint16_t>;
/// What the images of each file add up to.
using PerFile = std::vector<Measured>;

/// The mean over all; NaN where there is nothing.
double pooled(const PerFile& files, const FileCounts& counts);

/// Draws files again and again, as often as there are, with replacement. What several images of one file show is no
/// independent evidence, so files are drawn, not images. The same draws for all that is asked of one object, so that
/// differences are paired. [Efron and Tibshirani 1993]
class Bootstrap {
public:
    static constexpr int kResamples = 1000;

    Bootstrap(std::size_t files, std::uint64_t seed);

    /// `statistic(counts)` for the files as they are (each counts 1), and the 2.5th and 97.5th percentiles over the
    /// draws; those where it is not finite are left out. With fewer than two files there is no interval: NaN.
    template<class Statistic> Interval interval(const Statistic& statistic) const
    {
        std::vector<double> values;
        for (const FileCounts& counts : m_draws)
            values.push_back(statistic(counts));
        return interval_of(statistic(FileCounts(m_files, 1)), std::move(values));
    }

private:
    static Interval interval_of(double value, std::vector<double> draws);

    std::size_t m_files;
    std::vector<FileCounts> m_draws; ///< how often each file was drawn
};

} // namespace srisp::tool
