// SPDX-License-Identifier: Apache-2.0
#include "train/learning/losses.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace srisp::train;

namespace {

torch::Tensor grey(double value)
{
    return torch::full({ 1, 3, 4, 4 }, value);
}

/// The value of the only term in use.
double only(const LossSettings& settings, const Compared& images)
{
    const std::vector<LossTerm> terms = loss_terms(settings, images);
    REQUIRE(terms.size() == 1);
    return terms[0].values[0].item<double>();
}

LossSettings nothing()
{
    LossSettings settings;
    settings.reverse = settings.forward = 0;
    return settings;
}

} // namespace

TEST_CASE("the loss is the paper's two terms")
{
    const LossSettings settings;
    const std::vector<LossTerm> terms = loss_terms(settings, { grey(0.5), grey(0.2), grey(0.3), grey(0.6), {}, {} });
    REQUIRE(terms.size() == 2);
    CHECK(terms[0].name == "reverse");
    CHECK(terms[0].values[0].item<double>() ==
          doctest::Approx(std::pow(0.3, 1 / 2.2) - std::pow(0.2, 1 / 2.2)).epsilon(1e-5));
    CHECK(terms[1].name == "forward");
    CHECK(terms[1].values[0].item<double>() == doctest::Approx(0.1).epsilon(1e-5));
}

TEST_CASE("a method without a forward pass is judged by the reverse one alone")
{
    CHECK(loss_terms({}, { grey(0.5), grey(0.2), grey(0.3), {}, {}, {} }).size() == 1);
}

TEST_CASE("black has a finite gradient")
{
    torch::Tensor predicted = torch::zeros({ 1, 3, 4, 4 }).requires_grad_();
    loss_terms({}, { grey(0.5), grey(0.2), predicted, {}, {}, {} })[0].values.sum().backward();
    CHECK(predicted.grad().isfinite().all().item<bool>());
}

TEST_CASE("terms for brightness, highlights, round trip and white")
{
    LossSettings settings = nothing();
    settings.means = 1;
    CHECK(only(settings, { grey(0.5), grey(0.2), grey(0.2), {}, {}, {} }) == 0);
    // Twice too bright: all of the squares are missed.
    CHECK(only(settings, { grey(0.5), grey(0.2), grey(0.4), {}, {}, {} }) ==
          doctest::Approx(std::log(1 + 1 / 0.04)).epsilon(1e-5));

    torch::Tensor reddish = grey(0.4);
    reddish[0][0].fill_(0.8);
    CHECK(only(settings, { grey(0.5), grey(0.2), reddish, {}, {}, {} }) ==
          doctest::Approx(std::log(1 + (9 + 1 + 1) / 3.0 / 0.04) + std::log(1 + std::pow(std::log(2), 2) / 0.01))
              .epsilon(1e-5));

    // Where an anchor expects a mean, that is what the brightness is compared with; the colour still with the truth.
    const torch::Tensor expected = torch::full({ 1, 3 }, std::log(0.4));
    CHECK(only(settings, { grey(0.5), grey(0.2), grey(0.4), {}, {}, expected }) == doctest::Approx(0).epsilon(1e-5));
    CHECK(only(settings, { grey(0.5), grey(0.2), reddish, {}, {}, expected }) ==
          doctest::Approx(std::log(1 + 1 / 3.0 / 0.04) + std::log(1 + std::pow(std::log(2), 2) / 0.01)).epsilon(1e-5));

    // Highlights that come out half as bright are missed, and cost extra; too bright ones cost no more than others.
    CHECK(only(settings, { grey(0.5), grey(0.9), grey(0.45), {}, {}, {} }) ==
          doctest::Approx(std::log(1 + 0.25 / 0.04) + 60 * 0.45).epsilon(1e-5));
    CHECK(only(settings, { grey(0.5), grey(0.9), grey(1.8), {}, {}, {} }) ==
          doctest::Approx(std::log(1 + 1 / 0.04)).epsilon(1e-5));

    settings = nothing();
    settings.angle = 1;
    CHECK(only(settings, { grey(0.5), grey(0.2), grey(0.4), {}, {}, {} }) == doctest::Approx(0).epsilon(1e-3));
    // (2, 1, 1) and (1, 1, 1) are 19.47° apart; the chord of that angle.
    CHECK(only(settings, { grey(0.5), grey(0.2), reddish, {}, {}, {} }) ==
          doctest::Approx(2 * std::sin(19.4712 / 2 * M_PI / 180)).epsilon(1e-3));

    settings = nothing();
    settings.linear = 1;
    CHECK(only(settings, { grey(0.5), grey(0.2), grey(0.4), {}, {}, {} }) == doctest::Approx(0.2).epsilon(1e-5));

    settings = nothing();
    settings.highlights = 1;
    torch::Tensor truth = grey(0.2);
    truth[0][1][0][0] = 0.9;
    CHECK(only(settings, { grey(0.5), truth, grey(0.4), {}, {}, {} }) == doctest::Approx(0.5).epsilon(1e-5));
    CHECK(only(settings, { grey(0.5), truth, grey(0.95), {}, {}, {} }) == 0); // too bright costs the other terms only
    CHECK(only(settings, { grey(0.5), grey(0.2), grey(0.4), {}, {}, {} }) == 0);

    settings = nothing();
    settings.round_trip = 1;
    CHECK(needs_round_trip(settings));
    CHECK(only(settings, { grey(0.5), grey(0.2), grey(0.4), {}, grey(0.6), {} }) == doctest::Approx(0.1).epsilon(1e-5));

    settings = nothing();
    settings.white = 1;
    CHECK(needs_round_trip(settings));
    torch::Tensor photo = grey(0.5);
    photo.slice(2, 0, 1).fill_(1);
    CHECK(only(settings, { photo, grey(0.2), grey(0.4), {}, grey(0.7), {} }) == doctest::Approx(0.3).epsilon(1e-5));
    photo[0][0].slice(0, 0, 1).fill_(0.5); // red is not clipped: not white
    CHECK(only(settings, { photo, grey(0.2), grey(0.4), {}, grey(0.7), {} }) == 0);
}

TEST_CASE("every term gives one value per image")
{
    LossSettings settings;
    settings.linear = settings.means = settings.angle = settings.highlights = settings.round_trip = settings.white = 1;
    const torch::Tensor images = torch::rand({ 5, 3, 4, 4 });
    const std::vector<LossTerm> terms =
        loss_terms(settings, { images, images.flip({ 0 }), images, images * 0.5, images * 0.7, {} });
    CHECK(terms.size() == 8);
    for (const LossTerm& term : terms) {
        CAPTURE(term.name);
        CHECK(term.values.sizes() == torch::IntArrayRef{ 5 });
    }
}
