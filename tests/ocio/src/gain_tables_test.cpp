// SPDX-License-Identifier: Apache-2.0
#include "operators.h"

#include <doctest/doctest.h>

#include "image_compare.h"
#include "kernels/pointwise.h"
#include "ocio/ocio_pixels.h"

using namespace srisp;

namespace {

Colors by_formula(const Colors& rgb, const std::array<float, 3>& scales)
{
    const std::size_t count = rgb.size() / 3;
    std::vector<float> planes(rgb.size());
    for (std::size_t i = 0; i < rgb.size(); ++i)
        planes[i % 3 * count + i / 3] = rgb[i];
    scalar::inverse_gain({ planes.data(), std::ptrdiff_t(count) }, { planes.data(), std::ptrdiff_t(count) }, count,
                         scales.data());
    Colors result(rgb.size());
    for (std::size_t i = 0; i < rgb.size(); ++i)
        result[i] = planes[i % 3 * count + i / 3];
    return result;
}

Colors scaled(Colors rgb, const std::array<float, 3>& factors)
{
    for (std::size_t i = 0; i < rgb.size(); ++i)
        rgb[i] *= factors[i % 3];
    return rgb;
}

} // namespace

TEST_CASE("the table of the inverse gains errs by less than 6e-4 of the largest value, also beyond 1 and near white")
{
    const std::array<float, 3> all_scales[] = { { 0.5f, 1, 0.6f },     { 0.3f, 0.3f, 0.3f }, { 1.6f, 1, 0.4f },
                                                { 0.9f, 1.05f, 0.2f }, { 4, 1, 0.1f },       { 0.01f, 0.99f, 0.5f } };
    const std::array<float, 3> limits[] = { { 1, 1, 1 }, { 1.4f, 1, 1 }, { 1, 1, 2.7f } };
    for (const auto& scales : all_scales)
        for (const auto& limit : limits) {
            std::array<float, 3> most = limit;
            Operators operators;
            append_inverse_gain(operators, scales, most);
            const auto group = ocio_group(operators);
            Colors white = near_white(20000);
            for (std::size_t i = 0; i < white.size(); ++i)
                white[i] = std::min(1.1f * white[i], limit[i % 3]);
            for (const Colors& in : { scaled(dense_grid(30), limit), white }) {
                const Difference difference = compare(through_ocio(group, in), by_formula(in, scales));
                INFO("scales ", scales[0], " ", scales[1], " ", scales[2], ": ", difference.text);
                CHECK(difference.largest <= 6e-4 * std::max({ most[0], most[1], most[2] }));
            }
            for (int c = 0; c < 3; ++c)
                CHECK(most[c] == doctest::Approx(limit[c] * std::max(1.0f, scales[c])));
        }
}

TEST_CASE("inverse gains of at least 1 are a plain matrix")
{
    std::array<float, 3> most{ 1, 1, 1 };
    Operators operators;
    append_inverse_gain(operators, { 1.5f, 1, 2 }, most);
    REQUIRE(operators.size() == 1);
    CHECK(std::get<Affine>(operators[0]).matrix == std::array<double, 9>{ 1.5, 0, 0, 0, 1, 0, 0, 0, 2 });
}

TEST_CASE("white stays white")
{
    std::array<float, 3> most{ 1, 1, 1 };
    Operators operators;
    append_inverse_gain(operators, { 0.4f, 1, 0.7f }, most);
    const Colors white = through_ocio(ocio_group(operators), { 1, 1, 1 });
    for (const float value : white)
        CHECK(value == doctest::Approx(1).epsilon(1e-6));
}
