// SPDX-License-Identifier: Apache-2.0
#include "operators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace srisp {

namespace {

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

// 41 points: 39 cells of 0.0026 between grey 0.9 and 1, where m is a parabola. A straight line between two of its
// points lies above it by up to h² / 4 of a cell's height; so the points between the ends are set half of that lower.
constexpr int kGainPoints = 41, kGainCells = kGainPoints - 1;

/// 0 … 0.9 is one cell, and so is what lies above 1 (`tenths` · 0.1 at the end): there m is constant.
Corners grey_corners(int tenths)
{
    Corners corners{ { 0, 9.0 / tenths }, { 0, 1.0 / kGainCells } };
    corners.from.push_back(10.0 / tenths);
    corners.to.push_back(tenths > 10 ? double(kGainCells - 1) / kGainCells : 1);
    if (tenths > 10) {
        corners.from.push_back(1);
        corners.to.push_back(1);
    }
    return corners;
}

/// Differences from −`reach` to `reach`; those from `low` (< 0) to `high` (> 0) occur where grey is 0.9 … 1.
Corners difference_corners(double reach, double low, double high, int samples)
{
    const double step = 1.0 / (samples - 1);
    const auto normalized = [&](double d) { return (d + reach) / (2 * reach); };
    const double from = std::max(std::floor(normalized(low) / step), 1.0) * step;
    const double to = std::min(std::ceil(normalized(high) / step), samples - 2.0) * step;
    const int fine = kGainCells - 2,
              below = std::clamp(int(std::lround(fine * (0.5 - from) / (to - from))), 1, fine - 1);
    return { { 0, from, 0.5, to, 1 },
             { 0, 1.0 / kGainCells, (1.0 + below) / kGainCells, (kGainCells - 1.0) / kGainCells, 1 } };
}

/// The differences from grey that the channel `c` can have where grey is within 0.9 … 1.
std::array<double, 2> differences_near_white(const std::array<float, 3>& most, int c)
{
    const double others = double(most[(c + 1) % 3]) + most[(c + 2) % 3];
    return { std::clamp(1.8 - others, -1.0, -0.05), std::clamp(double(most[c]) - 0.9, 0.05, 2.0) };
}

/// m at the points of the table's first axis, balanced for straight lines between them.
double balanced_mask(double grey, int cells)
{
    const double above = std::clamp((grey - 0.9) / 0.1, 0.0, 1.0), cell = 1.0 / cells;
    const bool between = above > cell / 2 && above < 1 - cell / 2;
    return above * above - (between ? cell * cell / 8 : 0);
}

/// The formula with factors s + m (1 − s), s < 1, and s otherwise.
std::array<double, 3> inverse_gain(double m, const std::array<double, 3>& v, const std::array<float, 3>& scales)
{
    std::array<double, 3> result;
    for (int c = 0; c < 3; ++c)
        result[c] = v[c] * (scales[c] + m * std::max(1.0 - scales[c], 0.0));
    return result;
}

} // namespace

void append_inverse_gain(Operators& operators, const std::array<float, 3>& scales, std::array<float, 3>& most)
{
    const std::array<float, 3> in = most;
    for (int c = 0; c < 3; ++c)
        most[c] *= std::max(scales[c], 1.0f);
    if (std::all_of(scales.begin(), scales.end(), [](float s) { return s >= 1; })) {
        operators.push_back(diagonal(scales[0], scales[1], scales[2]));
        return;
    }
    const double sum = double(in[0]) + in[1] + in[2];
    const int tenths = std::max(10, int(std::ceil(sum / 0.3 - 1e-6)));
    const int samples = tenths * kPointsPerTenth + 1;
    std::array<Corners, 3> corners{ grey_corners(tenths) };
    std::array<double, 3> reach{};
    for (const int channel : { 0, 2 }) { // R, B; they are the second and third axis
        const int axis = channel == 0 ? 1 : 2;
        reach[axis] = std::max((sum - in[channel]) / 3, 2.0 / 3 * in[channel]);
        const auto [low, high] = differences_near_white(in, channel);
        corners[axis] = difference_corners(reach[axis], low, high, samples);
    }

    const double grey = 1 / (0.3 * tenths), r = 1 / (6 * reach[1]), b = 1 / (6 * reach[2]);
    operators.push_back(Affine{ { grey, grey, grey, 2 * r, -r, -r, -b, -b, 2 * b }, { 0, 0.5, 0.5 } });

    Curves curves{ samples, {} };
    for (int i = 0; i < samples; ++i)
        for (const Corners& axis : corners)
            curves.rgb.push_back(static_cast<float>(axis(double(i) / (samples - 1))));
    operators.push_back(std::move(curves));

    Cube cube{ kGainPoints, {} };
    for (int i = 0; i < kGainPoints; ++i)
        for (int j = 0; j < kGainPoints; ++j)
            for (int k = 0; k < kGainPoints; ++k) {
                const double at = corners[0].inverse(double(i) / kGainCells) * 0.1 * tenths;
                const double dr = (2 * corners[1].inverse(double(j) / kGainCells) - 1) * reach[1];
                const double db = (2 * corners[2].inverse(double(k) / kGainCells) - 1) * reach[2];
                const double m = balanced_mask(at, tenths > 10 ? kGainCells - 2 : kGainCells - 1);
                for (const double value : inverse_gain(m, { at + dr, at - dr - db, at + db }, scales))
                    cube.rgb.push_back(static_cast<float>(value));
            }
    operators.push_back(std::move(cube));
}

namespace {

// 65 points: one cell from 0 to 0.9, 24 to 1, 39 above.
constexpr int kHighlightPoints = 65, kHighlightCells = kHighlightPoints - 1, kFine = 24;
// Of the curves that look them up: so many from 1 to the limit, and at most so many per 0.1. A limit may be as close to
// 1 as it likes; nearer than the two allow, it is taken to lie there.
constexpr int kPointsAboveOne = 8, kMostPointsPerTenth = 3200;
constexpr double kLeastLimit = 1 + kPointsAboveOne / (10.0 * kMostPointsPerTenth);

/// The formula without its limit, 1 / gain: points beyond it continue it, so that the cell with the limit has no bend.
std::array<double, 3> rebuilt(const std::array<double, 3>& u, double gain, double limit)
{
    double sum = 0, top = 1;
    for (const double value : u) {
        sum += std::min(value, 1.0);
        top = std::max(top, value);
    }
    // A parabola, balanced as in balanced_mask, for half of the steps of all three channels together.
    const double near_white = std::clamp((sum - 2.9) / 0.1, 0.0, 1.0), step = 1.5 / kFine;
    const bool between = near_white > 0 && near_white < 1;
    const double height = (top - 1) / (limit - 1);
    const double m = std::max(near_white * near_white - (between ? step * step / 8 : 0), 0.0) * height * height;
    std::array<double, 3> result;
    for (int c = 0; c < 3; ++c)
        result[c] = gain * (u[c] + m * (top - u[c]));
    return result;
}

} // namespace

void append_rebuilt_highlights(Operators& operators, double gain, double most)
{
    // 0.9 and 1 are to lie on points of the curves.
    const double limit = std::max(1 / gain, kLeastLimit), reached = std::max(std::min(limit, most), kLeastLimit) - 1;
    const int per_tenth = std::max(int(std::ceil(kPointsAboveOne / (10 * reached) - 1e-6)), kPointsPerTenth);
    const int above = int(std::ceil(10 * per_tenth * reached - 1e-6));
    const double end = 1 + above / (10.0 * per_tenth);
    const Corners corners{ { 0, 0.9 / end, 1 / end, 1 },
                           { 0, 1.0 / kHighlightCells, (1.0 + kFine) / kHighlightCells, 1 } };
    operators.push_back(Clamp{ 0, static_cast<float>(limit) });
    operators.push_back(diagonal(1 / end, 1 / end, 1 / end));

    Curves curves{ 10 * per_tenth + above + 1, {} };
    for (int i = 0; i < curves.size; ++i)
        curves.rgb.insert(curves.rgb.end(), 3, static_cast<float>(corners(double(i) / (curves.size - 1))));
    operators.push_back(std::move(curves));

    std::array<double, kHighlightPoints> values;
    for (int i = 0; i < kHighlightPoints; ++i)
        values[i] = end * corners.inverse(double(i) / kHighlightCells);
    Cube cube{ kHighlightPoints, {} };
    cube.rgb.reserve(std::size_t(3) * kHighlightPoints * kHighlightPoints * kHighlightPoints);
    for (int r = 0; r < kHighlightPoints; ++r)
        for (int g = 0; g < kHighlightPoints; ++g)
            for (int b = 0; b < kHighlightPoints; ++b)
                for (const double value : rebuilt({ values[r], values[g], values[b] }, gain, limit))
                    cube.rgb.push_back(static_cast<float>(value));
    operators.push_back(std::move(cube));
    operators.push_back(Clamp{ 0, 1 });
}

} // namespace srisp
