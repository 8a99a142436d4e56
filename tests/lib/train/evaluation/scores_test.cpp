// SPDX-License-Identifier: Apache-2.0
#include "train/evaluation/scores.h"

#include <cmath>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace srisp;
using namespace srisp::train;

namespace {

/// An image of four pixels of one colour.
struct Flat {
    std::vector<float> rgb;

    explicit Flat(float r, float g, float b)
    {
        for (int i = 0; i < 4; ++i)
            rgb.insert(rgb.end(), { r, g, b });
    }
    ImageView view() const { return { rgb.data(), 2, 2, 3, 6 }; }
};

Measure measure_of(const Flat& result, const Flat& truth)
{
    Measure measure;
    measure.add(result.view(), truth.view());
    return measure;
}

/// Gain match is 0.1 off, its oracle 0.01; the model 0.05.
Scores one_group()
{
    const Flat truth(0.5f, 0.5f, 0.5f);
    ScoreGroup group;
    group.set = "real";
    group.rendering = "random";
    group.gain_match = measure_of(Flat(0.6f, 0.5f, 0.5f), truth);
    group.gain_match_oracle = measure_of(Flat(0.51f, 0.5f, 0.5f), truth);
    group.model = measure_of(Flat(0.55f, 0.5f, 0.5f), truth);
    group.model_oracle = group.model_oracle_gain = group.model;
    Scores scores;
    scores.groups.push_back(group);
    return scores;
}

} // namespace

TEST_CASE("a measure holds the mean of the crops' dB and the error of the channels' log means")
{
    Measure measure = measure_of(Flat(0.1f, 0.2f, 0.1f), Flat(0.1f, 0.1f, 0.1f));
    const double first = 10 * std::log10(3 / 0.01);
    CHECK(measure.psnr() == doctest::Approx(first).epsilon(1e-6));
    CHECK(measure.log_error_mean() == doctest::Approx(std::log(2) / 3)); // of green alone
    CHECK(measure.log_error_deviation() == doctest::Approx(0));
    measure += measure_of(Flat(0.1f, 0.1f, 0.1f), Flat(0.1f, 0.2f, 0.1f));
    CHECK(measure.crops == 2);
    CHECK(measure.psnr() == doctest::Approx(first).epsilon(1e-6));
    CHECK(measure.log_error_mean() == doctest::Approx(0));
    CHECK(measure.log_error_deviation() == doctest::Approx(std::log(2) / 3));
}

TEST_CASE("the covered part is that of the way from gain match to gain match with the truth's means")
{
    const ScoreGroup group = one_group().groups.front();
    CHECK(group.psnr_gain() == doctest::Approx(20 * std::log10(2)).epsilon(1e-5));
    CHECK(group.covered() == doctest::Approx(std::log10(2)).epsilon(1e-5));
    CHECK(group.angle_ratio() == doctest::Approx(0.5).epsilon(0.06)); // the angle is nearly linear in the difference
}

TEST_CASE("scores are found by set and rendering, and JSON has null where there is no number")
{
    const Scores scores = one_group();
    CHECK(scores.find("real", "random") == &scores.groups.front());
    CHECK(scores.find("real", "fixed") == nullptr);
    const nlohmann::ordered_json json = score_json(scores);
    CHECK(json["groups"][0]["covered"].get<double>() == doctest::Approx(std::log10(2)).epsilon(1e-5));
    CHECK(json["groups"][0]["model"]["highlight_error"].is_null());
    CHECK(json["groups"][0]["camera"].is_null());
}

TEST_CASE("the table shows gain match first, then each method by name")
{
    const std::string table = score_table({ { "mine", one_group() }, { "other", one_group() } }, false);
    const std::size_t gain_match = table.find("gain match"), mine = table.find("mine"), other = table.find("other");
    CHECK(gain_match < mine);
    CHECK(mine < other);
    REQUIRE(other != std::string::npos);
    CHECK(table.find("+6.02") != std::string::npos);
    CHECK(table.find("30 %") != std::string::npos);
}
