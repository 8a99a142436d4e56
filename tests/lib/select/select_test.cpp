// SPDX-License-Identifier: Apache-2.0
#include <srisp/select.h>

#include <cmath>
#include <numeric>

#include <doctest/doctest.h>
#include <srisp/model.h>

#include "random_model.h"

using namespace srisp;

namespace {

Thumbnail random_thumbnail(std::uint64_t seed, float brightest)
{
    Thumbnail thumbnail;
    Random random(seed);
    for (float& value : thumbnail.rgb)
        value = random.uniform(0, brightest);
    return thumbnail;
}

std::shared_ptr<const Model> default_model()
{
    Expected<std::shared_ptr<const Model>> model = Model::load("default");
    REQUIRE_MESSAGE(model, (model ? "" : model.error().message));
    return *model;
}

Parameters selected(const Thumbnail& source, const Thumbnail& reference)
{
    Expected<Parameters> parameters = srisp::select(*default_model(), source, reference);
    REQUIRE_MESSAGE(parameters, (parameters ? "" : parameters.error().message));
    return *parameters;
}

} // namespace

TEST_CASE("select gives weights that sum to one, usable values and the model's name and hash")
{
    const Parameters p = selected(random_thumbnail(1, 1), random_thumbnail(2, 0.3f));
    for (const std::vector<float>& weights : { p.tone_weights[0], p.tone_weights[3], p.gamma_weights, p.color_weights,
                                               p.white_balance_weights, p.gain_weights })
        CHECK(std::accumulate(weights.begin(), weights.end(), 0.0) == doctest::Approx(1).epsilon(1e-6));
    CHECK(check_parameters(p, *default_model()));
    CHECK(p.model_name == "default");
    CHECK(p.white_balance[1] == 1.0f);
}

TEST_CASE("the same thumbnails give the same bits, and a darker reference a larger gain")
{
    const Thumbnail source = random_thumbnail(1, 1);
    const Parameters a = selected(source, random_thumbnail(2, 0.4f)), b = selected(source, random_thumbnail(2, 0.4f));
    CHECK(to_json(a) == to_json(b));
    CHECK(selected(source, random_thumbnail(2, 0.04f)).gain > 3 * a.gain);
}

TEST_CASE("values that are not within 0 … 1 are refused with their place")
{
    Thumbnail bad = random_thumbnail(1, 1);
    bad.rgb[(7 * 256 + 5) * 3 + 1] = NAN;
    Expected<Parameters> p = srisp::select(*default_model(), bad, random_thumbnail(2, 1));
    REQUIRE(!p);
    CHECK(p.error().message == "the source thumbnail has nan at (5, 7), must be within 0 … 1");
    p = srisp::select(*default_model(), random_thumbnail(2, 1), random_thumbnail(1, 2));
    REQUIRE(!p);
    CHECK(p.error().message.find("the reference thumbnail has 1.") == 0);
}

TEST_CASE("black, white and single-colour thumbnails still give usable parameters")
{
    for (const float level : { 0.0f, 1.0f }) {
        Thumbnail flat;
        std::fill(flat.rgb.begin(), flat.rgb.end(), level);
        CHECK(check_parameters(selected(flat, random_thumbnail(3, 0.5f)), *default_model()));
        CHECK(check_parameters(selected(random_thumbnail(3, 1), flat), *default_model()));
    }
}
