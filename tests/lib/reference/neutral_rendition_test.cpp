// SPDX-License-Identifier: Apache-2.0
#include <srisp/neutral_rendition.h>

#include <cmath>

#include <doctest/doctest.h>

using namespace srisp;

namespace {

/// A ramp of a grey surface, as a camera sees it whose neutral is `neutral`.
Reference ramp(const std::array<float, 3>& neutral, float exposure)
{
    Reference reference;
    std::vector<float>& rgb = reference.thumbnail.rgb;
    for (std::size_t i = 0; i < rgb.size(); ++i)
        rgb[i] = exposure * neutral[i % 3] * float(i / 3) / float(rgb.size() / 3);
    return reference;
}

} // namespace

TEST_CASE("a grey surface becomes grey, and equally bright for any exposure, by the neutral of the file or grey world")
{
    const std::array<float, 3> neutral{ 0.5f, 1, 0.7f };
    for (const bool known : { true, false })
        for (const float exposure : { 0.02f, 0.5f, 1.0f }) {
            Reference reference = ramp(neutral, exposure);
            if (known)
                reference.facts.as_shot_neutral = neutral;
            // A matrix with rows of any sum: white stays white.
            reference.facts.color_matrices.push_back({ { 0.8f, -0.2f, -0.1f, -0.4f, 1.2f, 0.2f, -0.1f, 0.2f, 0.6f } });
            const Thumbnail picture = neutral_rendition(reference);
            const std::size_t middle = picture.rgb.size() / 6 * 3; // half of the brightest
            // Half of 0.85 / 0.97, encoded by the sRGB curve.
            CHECK(picture.rgb[middle + 1] ==
                  doctest::Approx(1.055 * std::pow(0.5 * 0.85 / 0.97, 1 / 2.4) - 0.055).epsilon(2e-3));
            CHECK(picture.rgb[middle] == doctest::Approx(picture.rgb[middle + 1]).epsilon(1e-3));
            CHECK(picture.rgb[middle + 2] == doctest::Approx(picture.rgb[middle + 1]).epsilon(1e-3));
            CHECK(picture.rgb[0] == 0);
            CHECK(picture.rgb.back() <= 1);
        }
}

TEST_CASE("a camera's colours are brought to sRGB by its matrix")
{
    Reference reference = ramp({ 1, 1, 1 }, 1);
    reference.facts.as_shot_neutral = { 1, 1, 1 };
    for (std::size_t i = 0; i < reference.thumbnail.rgb.size(); i += 3)
        reference.thumbnail.rgb[i + 2] = 0; // a yellow
    const Thumbnail plain = neutral_rendition(reference);
    reference.facts.color_matrices.push_back({ { 0.8f, -0.2f, -0.1f, -0.4f, 1.2f, 0.2f, -0.1f, 0.2f, 0.6f } });
    const Thumbnail matrixed = neutral_rendition(reference);
    const std::size_t middle = plain.rgb.size() / 6 * 3;
    CHECK(plain.rgb[middle] == doctest::Approx(plain.rgb[middle + 1]).epsilon(1e-3));
    CHECK(std::abs(matrixed.rgb[middle] - matrixed.rgb[middle + 1]) > 0.03);
}

TEST_CASE("what is clipped in the RAW has no colour")
{
    Reference reference = ramp({ 0.5f, 1, 0.7f }, 1);
    reference.facts.as_shot_neutral = { 0.5f, 1, 0.7f };
    std::fill(reference.thumbnail.rgb.end() - 3000, reference.thumbnail.rgb.end(), 1.0f);
    const Thumbnail picture = neutral_rendition(reference);
    const std::size_t last = picture.rgb.size() - 3;
    CHECK(picture.rgb[last] == doctest::Approx(picture.rgb[last + 1]).epsilon(1e-5));
    CHECK(picture.rgb[last + 2] == doctest::Approx(picture.rgb[last + 1]).epsilon(1e-5));
}
