// SPDX-License-Identifier: Apache-2.0
#include "rebuilt_highlights_table.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace srisp {

namespace {

// 65 points: one cell from 0 to 0.9, 47 to 1, 16 above.
constexpr int kPoints = 65, kFine = 47, kCells = kPoints - 1;
// Points of the curves per 0.1. GPUs interpolate textures with 8 bits between two points.
constexpr int kPointsPerTenth = 64;

/// Values on the table's points, in units of the value, and between them the inverse: where on [0,1] a value lies.
struct Axis {
    double end; ///< the largest value

    double value(int point) const
    {
        if (point <= 1)
            return 0.9 * point;
        return point <= kFine + 1 ? 0.9 + 0.1 * (point - 1) / kFine
                                  : 1 + (end - 1) * (point - kFine - 1) / (kCells - kFine - 1);
    }
    double place(double value) const
    {
        if (value <= 0.9)
            return value / 0.9 / kCells;
        return (value <= 1 ? 1 + (value - 0.9) / 0.1 * kFine
                           : kFine + 1 + (value - 1) / (end - 1) * (kCells - kFine - 1)) /
               kCells;
    }
};

std::array<double, 3> rebuilt(const std::array<double, 3>& u)
{
    double sum = 0;
    for (const double value : u)
        sum += std::min(value, 1.0);
    const double above = std::clamp((sum - 2.9) / 0.1, 0.0, 1.0), m = above * above;
    const double top = std::max({ u[0], u[1], u[2] });
    std::array<double, 3> result;
    for (int c = 0; c < 3; ++c)
        result[c] = u[c] + m * (top - u[c]);
    return result;
}

} // namespace

void append_rebuilt_highlights(Operators& operators, double gain)
{
    // 0.9 and 1 are to lie on points of the curves.
    const int tenths = std::max(11, int(std::ceil(10 / gain - 1e-6)));
    const Axis axis{ tenths / 10.0 };
    operators.push_back(Clamp{ 0, static_cast<float>(1 / gain) });
    operators.push_back(diagonal(1 / axis.end, 1 / axis.end, 1 / axis.end));

    Curves curves{ tenths * kPointsPerTenth + 1, {} };
    for (int i = 0; i < curves.size; ++i)
        curves.rgb.insert(curves.rgb.end(), 3, static_cast<float>(axis.place(0.1 * i / kPointsPerTenth)));
    operators.push_back(std::move(curves));

    Cube cube{ kPoints, {} };
    cube.rgb.reserve(std::size_t(3) * kPoints * kPoints * kPoints);
    for (int r = 0; r < kPoints; ++r)
        for (int g = 0; g < kPoints; ++g)
            for (int b = 0; b < kPoints; ++b)
                for (const double value : rebuilt({ axis.value(r), axis.value(g), axis.value(b) }))
                    cube.rgb.push_back(static_cast<float>(gain * value));
    operators.push_back(std::move(cube));
    operators.push_back(Clamp{ 0, 1 });
}

} // namespace srisp
