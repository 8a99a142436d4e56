// SPDX-License-Identifier: Apache-2.0
#include <srisp/metrics.h>

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

using namespace srisp;

namespace {

/// Interleaved RGB values as an image of one row.
ImageView row(const std::vector<float>& rgb)
{
    const int width = static_cast<int>(rgb.size() / 3);
    return { rgb.data(), width, 1, 3, std::ptrdiff_t(3) * width };
}

constexpr std::array<float, 9> kXyzAsItIs{ 1, 0, 0, 0, 1, 0, 0, 0, 1 };

} // namespace

TEST_CASE("the PSNR is over all channels with peak 1, the result clamped, and infinite for equal images")
{
    const std::vector<float> truth{ 0.5f, 0.5f, 0.5f, 1, 1, 1 };
    CHECK(psnr(row({ 0.6f, 0.5f, 0.5f, 1, 1, 1 }), row(truth)) == doctest::Approx(10 * std::log10(6 / 0.01)));
    CHECK(psnr(row({ 0.6f, 0.5f, 0.5f, 3, 1, 1 }), row(truth)) == doctest::Approx(10 * std::log10(6 / 0.01)));
    CHECK(std::isinf(psnr(row({ 0.5f, 0.5f, 0.5f, 2, 2, 2 }), row(truth))));
}

TEST_CASE("the angle between two colours is that of the golden value, whatever their brightness")
{
    const double expected = 7.493293;
    CHECK(angular_error(row({ 1, .5f, .25f }), row({ .9f, .6f, .3f })).mean() ==
          doctest::Approx(expected).epsilon(4e-7));
    CHECK(angular_error(row({ .1f, .05f, .025f }), row({ .9f, .6f, .3f })).mean() ==
          doctest::Approx(expected).epsilon(1e-6));
}

TEST_CASE("nearly equal colours have a small angle, not the rounding of an arc cosine in single precision")
{
    CHECK(angular_error(row({ .3f, .3f, .3f }), row({ .3f, .3f, .3f })).mean() < 1e-5);
    CHECK(angular_error(row({ .3f, .3f, .30003f }), row({ .3f, .3f, .3f })).mean() ==
          doctest::Approx(0.00468).epsilon(0.01));
}

TEST_CASE("black pixels are skipped and counted, and images add up by pixels")
{
    AngularError error = angular_error(row({ 0, 0, 0, 1, 0, 0 }), row({ 1, 1, 1, 0, 1, 0 }));
    CHECK(error.skipped == 1);
    CHECK(error.mean() == doctest::Approx(90));
    error += angular_error(row({ 1, 1, 1, 1, 1, 1 }), row({ 1, 1, 1, 5e-7f, 0, 0 }));
    CHECK(error.skipped == 2);
    CHECK(error.pixels == 2);
    CHECK(error.mean() == doctest::Approx(45));
    CHECK(std::isnan(AngularError().mean()));
}

TEST_CASE("highlight errors are those of bright values, as they are and at the image's own gain")
{
    // Bright values 0.1 and 0.2 too dark in an image whose mid tones are at 0.8 of the truth.
    const HighlightErrors errors =
        highlight_errors(row({ .8f, .8f, .08f, .4f, 0, .9f }), row({ .9f, 1, .1f, .5f, 0, .7f }));
    CHECK(errors.values == 2);
    CHECK(errors.mean() == doctest::Approx(-0.15));
    CHECK(errors.mean_at_gain() == doctest::Approx(((0.8 / 0.8 - 0.9) + (0.8 / 0.8 - 1)) / 2).epsilon(1e-6));
}

TEST_CASE("an image without mid tones counts among the plain highlight errors alone")
{
    HighlightErrors errors = highlight_errors(row({ .5f, .5f, .5f }), row({ 1, 1, 1 }));
    CHECK(errors.values_at_gain == 0);
    CHECK(std::isnan(errors.mean_at_gain()));
    errors += highlight_errors(row({ 1, .2f, .2f }), row({ 1, .2f, .2f }));
    CHECK(errors.mean() == doctest::Approx(-0.375));
    CHECK(errors.mean_at_gain() == doctest::Approx(0));
}

TEST_CASE("Lab is that of the golden value, of white, and of black")
{
    const std::array<double, 3> lab = lab_from_xyz({ .2, .3, .1 });
    CHECK(lab[0] == doctest::Approx(61.6542).epsilon(2e-6));
    CHECK(lab[1] == doctest::Approx(-37.3213).epsilon(2e-6));
    CHECK(lab[2] == doctest::Approx(43.6513).epsilon(2e-6));
    CHECK(lab_from_xyz({ .95047, 1, 1.08883 })[0] == doctest::Approx(100));
    CHECK(std::abs(lab_from_xyz({ 0, 0, 0 })[0]) < 1e-12);
}

TEST_CASE("the histogram intersection is the part of the pixels that two sets have in common")
{
    LabHistogram grey, half_red, twice_grey;
    grey.add(row({ .4f, .4f, .4f, .4f, .4f, .4f }), kXyzAsItIs);
    twice_grey.add(row({ .4f, .4f, .4f }), kXyzAsItIs);
    half_red.add(row({ .4f, .4f, .4f, .4f, .1f, .05f }), kXyzAsItIs);
    CHECK(grey.intersection(twice_grey) == doctest::Approx(1));
    CHECK(grey.intersection(half_red) == doctest::Approx(0.5));
    CHECK(half_red.intersection(grey) == doctest::Approx(0.5));
    CHECK(grey.intersection(LabHistogram()) == 0);
}

TEST_CASE("the camera's matrix turns RAW values into the XYZ that are counted")
{
    LabHistogram direct, through_matrix;
    direct.add(row({ .2f, .3f, .1f }), kXyzAsItIs);
    through_matrix.add(row({ .1f, .6f, .2f }), { 2, 0, 0, 0, .5f, 0, 0, 0, .5f });
    CHECK(direct.intersection(through_matrix) == doctest::Approx(1));
}

TEST_CASE("the counts of several histograms add up to that of all their pixels")
{
    const std::vector<float> pixels{ 0.2f, 0.3f, 0.1f, 0.5f, 0.5f, 0.5f };
    constexpr std::array<float, 9> identity{ 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    LabHistogram first, second, both, sum;
    first.add({ pixels.data(), 1, 1, 3, 3 }, identity);
    second.add({ pixels.data() + 3, 1, 1, 3, 3 }, identity);
    both.add({ pixels.data(), 2, 1, 3, 6 }, identity);
    sum.add_counts(first.counts());
    sum.add_counts(second.counts());
    CHECK(sum.counts() == both.counts());
    CHECK(sum.intersection(both) == doctest::Approx(1));
    CHECK(first.intersection(sum) < 0.9);
}

TEST_CASE("the brightness of an image is the mean of the logs of its channel means, and black has one, too")
{
    const std::vector<float> pixels{ 0.1f, 0.2f, 0.4f, 0.3f, 0.2f, 0.0f };
    CHECK(log_brightness({ pixels.data(), 2, 1, 3, 6 }) ==
          doctest::Approx((std::log(0.2) + std::log(0.2) + std::log(0.2)) / 3));
    const std::vector<float> black(3);
    CHECK(log_brightness({ black.data(), 1, 1, 3, 3 }) == doctest::Approx(std::log(1e-5)));
}

TEST_CASE("the rank correlation asks for the order alone")
{
    CHECK(rank_correlation({ 1, 2, 3, 4 }, { 10, 11, 500, 501 }) == doctest::Approx(1));
    CHECK(rank_correlation({ 1, 2, 3, 4 }, { 4, 3, 2, 1 }) == doctest::Approx(-1));
    // One exchange of neighbours among four: 1 − 6 · 2 / (4 · 15).
    CHECK(rank_correlation({ 1, 2, 3, 4 }, { 1, 3, 2, 4 }) == doctest::Approx(0.8));
}

TEST_CASE("equal values share their rank, and a list without any order has no correlation")
{
    CHECK(rank_correlation({ 1, 2, 2, 3 }, { 1, 2, 2, 3 }) == doctest::Approx(1));
    CHECK(rank_correlation({ 1, 2, 2, 3 }, { 1, 2, 3, 4 }) == doctest::Approx(4.5 / std::sqrt(4.5 * 5)));
    CHECK(std::isnan(rank_correlation({ 1, 1, 1 }, { 1, 2, 3 })));
    CHECK(std::isnan(rank_correlation({ 1 }, { 1 })));
}
