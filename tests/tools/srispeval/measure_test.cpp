// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispeval/measure.h"

#include <doctest/doctest.h>

#include <cmath>

#include "../../../tools/srispeval/metric_table.h"
#include "base/random.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

Pixels random_pixels(int width, int height, float low, float high)
{
    Pixels pixels(width, height);
    Random random(3);
    for (float& value : pixels.rgb)
        value = float(random.uniform(low, high));
    return pixels;
}

Pixels times(Pixels pixels, float gain)
{
    for (float& value : pixels.rgb)
        value *= gain;
    return pixels;
}

TestImage some_image()
{
    TestImage image;
    image.truth = random_pixels(40, 30, 0.01f, 0.5f);
    image.reference = random_pixels(20, 20, 0.01f, 0.5f);
    image.photo = image.truth;
    image.colors.white_balance = { 2, 1, 1.5f };
    image.colors.to_xyz = kSrgbToXyz;
    image.score.image = "a.dng";
    return image;
}

double value(const MethodScore& score, const char* key)
{
    return score.values.at(key).value();
}

} // namespace

TEST_CASE("the truth itself has no error by any measure")
{
    const TestImage image = some_image();
    const MethodScore score = measure_result(image, { image.truth, 0.2f, "{}" }, {});
    CHECK(value(score, key::kPsnr) == 100);
    CHECK(value(score, key::kSsim) == doctest::Approx(1));
    CHECK(value(score, key::kAngle) == doctest::Approx(0).epsilon(1e-5));
    CHECK(value(score, key::kDeltaE) == doctest::Approx(0));
    CHECK(value(score, key::kLab) == doctest::Approx(1));
    CHECK(value(score, key::kBrightness) == 0);
    CHECK(value(score, key::kEdits) == 100);
    CHECK(value(score, key::kWithinOne) == 1);
    CHECK(score.values.at(key::kHighlights).weight == 0);
}

TEST_CASE("a result at half the brightness: what each measure says")
{
    const TestImage image = some_image();
    const MethodScore score = measure_result(image, { times(image.truth, 0.5f), float(std::log(2.0)), "{}" }, {});
    CHECK(value(score, key::kBrightness) == doctest::Approx(-std::log(2.0)));
    CHECK(value(score, key::kDeviation) == doctest::Approx(1)); // told in EV
    CHECK(value(score, key::kErrorInDeviations) == doctest::Approx(1).epsilon(1e-5));
    CHECK(value(score, key::kAngle) < 1e-3);
    CHECK(value(score, key::kPsnrAtGain) > 90);
    CHECK(value(score, key::kPsnrAtMeans) > 90);
    CHECK(value(score, key::kPsnr) < 30);
    CHECK(value(score, key::kEdits) < value(score, key::kPsnr)); // what is edited is brighter
    // Errors by level: −truth / 2; the level [1/4, 1/2) has the largest.
    CHECK(score.error_by_level[7].value() == doctest::Approx(-0.1875).epsilon(0.05));
    CHECK(score.error_by_level[8].weight == 0);
    double values = 0;
    for (const Measured& level : score.error_by_level)
        values += level.weight;
    CHECK(values == image.truth.rgb.size());
}

TEST_CASE("without a matrix nothing is said of seen colours, and unpaired results are held against the reference")
{
    TestImage image = some_image();
    image.colors.to_xyz.reset();
    CHECK(measure_result(image, { image.truth, {}, "{}" }, {}).values.count(key::kDeltaE) == 0);
    image = some_image();
    const MethodScore score = measure_unpaired(image, { image.reference, {}, "{}" });
    CHECK(value(score, key::kLab) == doctest::Approx(1));
    CHECK(score.values.count(key::kPsnr) == 0);
}

TEST_CASE("gain match gives the reference's means; UPI depends on the image's name and the seed alone")
{
    const Pixels photo = random_pixels(40, 30, 0.2f, 0.7f), reference = random_pixels(16, 16, 0.02f, 0.2f);
    const auto matched = make_gain_match()->unprocess(photo, reference, "a");
    REQUIRE(matched);
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(matched->raw.means()[c] == doctest::Approx(reference.means()[c]).epsilon(1e-4));
    const auto upi = make_upi(1);
    CHECK(upi->unprocess(photo, reference, "a")->raw.rgb == make_upi(1)->unprocess(photo, photo, "a")->raw.rgb);
    CHECK(upi->unprocess(photo, reference, "a")->raw.rgb != upi->unprocess(photo, reference, "b")->raw.rgb);
    CHECK(upi->unprocess(photo, reference, "a")->raw.rgb != make_upi(2)->unprocess(photo, reference, "a")->raw.rgb);
}
