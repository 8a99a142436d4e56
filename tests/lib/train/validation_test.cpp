// SPDX-License-Identifier: Apache-2.0
#include "validation.h"

#include <doctest/doctest.h>

using namespace srisp;
using namespace srisp::train;

namespace {

/// Two grey pixels, of which the second is the highlight, against a truth of 0.5 and 0.9.
ScoreGroup group_of(const char* set, float dark, float bright)
{
    const std::vector<float> result{ dark, dark, dark, bright, bright, bright },
        truth{ 0.5f, 0.5f, 0.5f, 0.9f, 0.9f, 0.9f };
    ScoreGroup group;
    group.set = set;
    group.rendering = "random";
    group.model.add({ result.data(), 2, 1, 3, 6 }, { truth.data(), 2, 1, 3, 6 });
    return group;
}

} // namespace

TEST_CASE("A validation's score takes one dB for each tenth that the highlights are off at one gain")
{
    Scores scores;
    scores.groups = { group_of("real", 0.25f, 0.40f) };
    const Validation result = validation_of(scores, "real");
    CHECK(result.angle == doctest::Approx(0).epsilon(1e-3).scale(1));
    // Twice as bright it is 0.5 and 0.8: 0.1 off.
    CHECK(result.score == doctest::Approx(result.psnr - result.angle - 1).epsilon(1e-4));
}

TEST_CASE("A validation without highlights has a score")
{
    Scores scores;
    scores.groups = { group_of("real", 0.4f, 0.9f) };
    scores.groups[0].model.highlights = {};
    const Validation result = validation_of(scores, "real");
    CHECK(result.score == doctest::Approx(result.psnr - result.angle));
}

TEST_CASE("A validation counts the set that is asked for, and all where that is not there")
{
    Scores scores;
    scores.groups = { group_of("real", 0.5f, 0.8f), group_of("simulated", 0.5f, 0.7f) };
    const double real = validation_of(scores, "real").psnr, simulated = validation_of(scores, "simulated").psnr;
    CHECK(real > simulated);
    CHECK(validation_of(scores, "all").psnr == doctest::Approx((real + simulated) / 2));
    scores.groups.pop_back();
    CHECK(validation_of(scores, "simulated").psnr == doctest::Approx(real));
}
