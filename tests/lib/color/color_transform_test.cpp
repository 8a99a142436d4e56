// SPDX-License-Identifier: Apache-2.0
#include "color/color_transform.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

using namespace srisp;

namespace {

double srgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

} // namespace

TEST_CASE("the sRGB curve's table is exact to 5e-7")
{
    double worst = 0;
    for (int i = 0; i <= 1000003; ++i) {
        const float v = static_cast<float>(i / 1000003.0);
        worst = std::max(worst, std::fabs(srgb_encoded(v) - srgb(v)));
    }
    INFO("largest difference " << worst);
    CHECK(worst < 5e-7);
}
