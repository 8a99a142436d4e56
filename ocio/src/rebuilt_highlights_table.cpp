// SPDX-License-Identifier: Apache-2.0
#include "rebuilt_highlights_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "corners.h"

namespace srisp {

namespace {

// 65 points: one cell from 0 to 0.9, 24 to 1, 39 above.
constexpr int kPoints = 65, kCells = kPoints - 1, kFine = 24;

/// The formula without the limit 1 / gain: points beyond it continue it, so that the cell with the limit has no bend.
std::array<double, 3> rebuilt(const std::array<double, 3>& u, double gain)
{
    double sum = 0, top = 1;
    for (const double value : u) {
        sum += std::min(value, 1.0);
        top = std::max(top, value);
    }
    const double root = std::clamp((sum - 2.9) / 0.1, 0.0, 1.0) * (top - 1) / (1 / gain - 1), m = root * root;
    std::array<double, 3> result;
    for (int c = 0; c < 3; ++c)
        result[c] = gain * (u[c] + m * (top - u[c]));
    return result;
}

} // namespace

void append_rebuilt_highlights(Operators& operators, double gain, double most)
{
    // 0.9 and 1 are to lie on points of the curves.
    const int tenths = std::max(11, int(std::ceil(10 * std::min(1 / gain, most) - 1e-6)));
    const Corners corners{ { 0, 9.0 / tenths, 10.0 / tenths, 1 }, { 0, 1.0 / kCells, (1.0 + kFine) / kCells, 1 } };
    operators.push_back(Clamp{ 0, static_cast<float>(1 / gain) });
    operators.push_back(diagonal(10.0 / tenths, 10.0 / tenths, 10.0 / tenths));

    Curves curves{ tenths * kPointsPerTenth + 1, {} };
    for (int i = 0; i < curves.size; ++i)
        curves.rgb.insert(curves.rgb.end(), 3, static_cast<float>(corners(double(i) / (curves.size - 1))));
    operators.push_back(std::move(curves));

    std::array<double, kPoints> values;
    for (int i = 0; i < kPoints; ++i)
        values[i] = 0.1 * tenths * corners.inverse(double(i) / kCells);
    Cube cube{ kPoints, {} };
    cube.rgb.reserve(std::size_t(3) * kPoints * kPoints * kPoints);
    for (int r = 0; r < kPoints; ++r)
        for (int g = 0; g < kPoints; ++g)
            for (int b = 0; b < kPoints; ++b)
                for (const double value : rebuilt({ values[r], values[g], values[b] }, gain))
                    cube.rgb.push_back(static_cast<float>(value));
    operators.push_back(std::move(cube));
    operators.push_back(Clamp{ 0, 1 });
}

} // namespace srisp
