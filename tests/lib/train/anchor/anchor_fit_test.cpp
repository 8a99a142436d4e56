// SPDX-License-Identifier: Apache-2.0
#include "train/anchor/anchor_fit.h"

#include <doctest/doctest.h>

#include "lib/train/tensor_tools.h"
#include "train/network/anchor_network.h"
#include "train/network/network.h"

using namespace srisp::train;

namespace {

/// All of a fit: nothing where there is none.
std::optional<AnchorFit> start_anchor(Unprocessor& model, Samples& samples, const AnchorFitSettings& settings,
                                      std::uint64_t seed, const std::function<void(double)>& progress = {})
{
    std::optional<AnchorPairs> pairs = pairs_for_anchor(model, settings);
    if (!pairs)
        return {};
    while (!pairs->complete())
        pairs->make_more(samples);
    const AnchorFit fit = fit_anchor(model, *pairs, settings, seed, progress);
    fit_anchor_deviation(model, *pairs, seed);
    return fit;
}

/// Pairs whose RAW is the linear photo, as bright as the reference says: three times as bright.
class SimplePairs : public Samples {
public:
    Batch batch(std::int64_t step, int first_pair, int pairs, int, int) override
    {
        const auto seed = static_cast<std::uint64_t>(step * 1000 + first_pair);
        Batch batch;
        batch.source = smooth_images(pairs, 16, 16, seed, 0.2, 0.9);
        batch.reference = smooth_images(pairs, 16, 16, seed + 7, 0.02, 0.3) *
                          torch::empty({ pairs, 1, 1, 1 }).uniform_(0.2, 1, at::detail::createCPUGenerator(seed));
        const torch::Tensor linear = batch.source.pow(2.2);
        batch.truth = linear * (3 * batch.reference.mean({ 2, 3 }, true) / linear.mean({ 2, 3 }, true));
        return batch;
    }
};

} // namespace

TEST_CASE("the closed form finds the line that made the values")
{
    const at::Generator generator = at::detail::createCPUGenerator(3);
    const torch::Tensor weight = torch::empty({ 3, 24 }).normal_(0, 0.2, generator);
    const torch::Tensor bias = torch::tensor({ -2.0f, -1.5f, -3.0f });
    const torch::Tensor statistics = torch::empty({ 300, 24 }).normal_(0, 1, generator);
    const torch::Tensor log_means = torch::addmm(bias, statistics, weight.t());
    const AnchorFit fit = fit_line(statistics, log_means, 0);
    CHECK(largest(fit.weight - weight) < 1e-4);
    CHECK(largest(fit.bias - bias) < 1e-4);
    const AnchorFit shrunk = fit_line(statistics, log_means, 10);
    CHECK(shrunk.weight.norm().item<double>() < 0.5 * fit.weight.norm().item<double>());
}

TEST_CASE("a model's anchor is fitted to its training pairs and then predicts their brightness")
{
    ModelSettings settings;
    settings.anchor_network = false;
    Network network(settings, 1);
    SimplePairs pairs;
    AnchorFitSettings few;
    few.pairs = 500;
    few.ridge = 1e-6;
    const std::optional<AnchorFit> fit = start_anchor(network, pairs, few, 1);
    REQUIRE(fit);
    CHECK(fit->gain_match_deviation == doctest::Approx(std::log(3)).epsilon(0.01));
    CHECK(fit->deviation < 0.02);
    CHECK(fit->deviation == fit->line_deviation);

    const Batch batch = pairs.batch(99, 0, 8, 0, 0);
    const torch::Tensor statistics =
        torch::cat({ image_statistics(linear_source(batch.source)), image_statistics(batch.reference) }, 1);
    const auto parameters = network.named_parameters();
    const torch::Tensor predicted =
        torch::addmm(parameters["anchor.bias"], statistics, parameters["anchor.weight"].t());
    CHECK(largest(predicted - batch.truth.mean({ 2, 3 }).log()) < 0.1);
}

/// Pairs whose brightness no line tells: it falls with the reference's exposure, then it rises.
class BentPairs : public Samples {
public:
    Batch batch(std::int64_t step, int, int pairs, int, int) override
    {
        at::Generator generator = at::detail::createCPUGenerator(static_cast<std::uint64_t>(step));
        Batch batch;
        batch.source = torch::empty({ pairs, 3, 16, 16 }).uniform_(0.2, 0.9, generator);
        const torch::Tensor exposure = torch::empty({ pairs, 1, 1, 1 }).uniform_(0.3, 3, generator);
        batch.reference = (torch::empty({ pairs, 3, 16, 16 }).uniform_(0, 1, generator) * exposure).clamp_max(1);
        batch.truth = torch::full({ pairs, 3, 16, 16 }, 0.1) * (exposure - 1.6).abs().exp();
        return batch;
    }
};

TEST_CASE("pairs that an earlier run made are gone on from, to the bit")
{
    SimplePairs samples;
    AnchorPairs whole(150, true), first(150, true), rest(150, true);
    while (!whole.complete())
        whole.make_more(samples);
    CHECK(whole.made() == 150);
    first.make_more(samples);
    REQUIRE(first.made() < 150);
    REQUIRE(rest.take(first.inputs(), first.means()));
    CHECK(rest.made() == first.made());
    while (!rest.complete())
        rest.make_more(samples);
    CHECK(torch::equal(rest.inputs(), whole.inputs()));
    CHECK(torch::equal(rest.means(), whole.means()));
    CHECK(rest.take(whole.inputs(), whole.means()));
    CHECK(rest.complete());

    AnchorPairs fewer(100, true), line(150, false);
    CHECK_FALSE(fewer.take(whole.inputs(), whole.means()));
    CHECK_FALSE(line.take(whole.inputs(), whole.means()));
    CHECK_FALSE(fewer.take(whole.inputs().slice(0, 0, 10), whole.means().slice(0, 0, 10)));
    CHECK_FALSE(fewer.take(whole.inputs().slice(0, 0, 64), whole.means().slice(0, 0, 63)));
    CHECK(fewer.made() == 0);
}

TEST_CASE("the anchor's network learns what its line misses, the same from the same seed")
{
    BentPairs pairs;
    AnchorFitSettings settings;
    settings.pairs = 2000;
    settings.steps = 800;
    Network network({}, 1), again({}, 1);
    double last = 0;
    const std::optional<AnchorFit> fit = start_anchor(network, pairs, settings, 5, [&last](double part) {
        CHECK(part >= last);
        last = part;
    });
    REQUIRE(fit);
    CHECK(last == 1);
    CHECK(fit->line_deviation > 0.1);
    CHECK(fit->deviation < 0.5 * fit->line_deviation);
    start_anchor(again, pairs, settings, 5);
    const Batch batch = pairs.batch(99, 0, 20, 0, 0);
    const torch::NoGradGuard no_gradient;
    CHECK(torch::equal(network.reverse(batch.source, batch.reference), again.reverse(batch.source, batch.reference)));
    // What the fit says of pairs that it held out holds for others, in the model itself: before any training its
    // dictionaries correct nothing on average, so the base gains are the anchor's.
    ChosenParameters choice;
    Trace trace;
    network.traced_reverse(batch.source, batch.reference, choice, &trace);
    const torch::Tensor predicted = trace["after_color"].mean({ 2, 3 }) / trace["base_gain"];
    const torch::Tensor error = (predicted / batch.truth.mean({ 2, 3 })).log();
    CHECK(error.square().mean().sqrt().item<double>() < 1.5 * fit->deviation);
}

TEST_CASE("a finished anchor is carried on: the line stays, the network learns from where it is")
{
    BentPairs pairs;
    AnchorFitSettings settings;
    settings.pairs = 2000;
    settings.steps = 20; // too few, so that more of them are sure to help
    Network network({}, 1);
    const std::optional<AnchorFit> first = start_anchor(network, pairs, settings, 5);
    REQUIRE(first);
    const torch::Tensor line = network.anchor_parameters()[0].detach().clone();
    const Batch batch = pairs.batch(99, 0, 20, 0, 0);
    const torch::Tensor before = network.reverse(batch.source, batch.reference);

    settings.carry_on = true;
    settings.steps = 1;
    settings.rate = 0;
    std::optional<AnchorFit> further = start_anchor(network, pairs, settings, 5);
    REQUIRE(further);
    CHECK(torch::equal(network.anchor_parameters()[0], line));
    CHECK(further->deviation == doctest::Approx(first->deviation).epsilon(1e-3));
    CHECK(torch::allclose(network.reverse(batch.source, batch.reference), before, 1e-3, 1e-4));

    settings.steps = 800;
    settings.rate = 1e-3;
    further = start_anchor(network, pairs, settings, 6);
    CHECK(further->deviation < first->deviation);
    CHECK(torch::equal(network.anchor_parameters()[0], line));
}

TEST_CASE("without a network there is nothing to carry on")
{
    ModelSettings line;
    line.anchor_network = false;
    Network network(line, 1);
    SimplePairs pairs;
    AnchorFitSettings settings;
    settings.carry_on = true;
    CHECK(!start_anchor(network, pairs, settings, 1));
}

TEST_CASE("a model without an anchor is left alone")
{
    ModelSettings settings;
    settings.anchor = false;
    Network network(settings, 1);
    SimplePairs pairs;
    CHECK(!start_anchor(network, pairs, {}, 1));
}

TEST_CASE("a model takes another's anchor, of whatever kernel size; not one of another kind")
{
    ModelSettings settings, pointwise, line;
    pointwise.kernel_size = "1";
    line.anchor_network = false;
    Network model(pointwise, 1), other(settings, 2), other_kind(line, 3);
    const torch::Tensor photo = smooth_images(1, 16, 16, 4, 0.2, 0.9), raw = smooth_images(1, 16, 16, 5, 0.02, 0.3);
    const auto base = [&](Network& network) {
        ChosenParameters choice;
        network.reverse(photo, raw, &choice);
        return choice.base;
    };
    {
        const torch::NoGradGuard no_gradient;
        for (torch::Tensor parameter : other.anchor_parameters())
            parameter.add_(0.01);
    }
    REQUIRE(take_anchor(model, other));
    const auto taken = model.anchor_parameters(), given = other.anchor_parameters();
    REQUIRE(taken.size() == given.size());
    for (std::size_t i = 0; i < taken.size(); ++i)
        CHECK(torch::equal(taken[i], given[i]));
    CHECK(base(model).isfinite().all().item<bool>());

    const srisp::Status status = take_anchor(model, other_kind);
    REQUIRE_FALSE(status);
    CHECK(status.error().message == "has an anchor of another kind than the recipe's model");
}

TEST_CASE("anchors are mixed weight by weight")
{
    ModelSettings settings;
    Network first(settings, 1), second(settings, 2), mixed(settings, 3);
    {
        const torch::NoGradGuard no_gradient;
        for (torch::Tensor parameter : first.anchor_parameters())
            parameter.fill_(1);
        for (torch::Tensor parameter : second.anchor_parameters())
            parameter.fill_(3);
    }
    mix_anchors(mixed, first, second, 0.25);
    for (const torch::Tensor& parameter : mixed.anchor_parameters())
        CHECK(parameter.eq(1.5).all().item<bool>());
}

/// Bright references tell the RAW's brightness, dark ones leave it within a factor of e^±1.
class UnsurePairs : public Samples {
public:
    Batch batch(std::int64_t step, int, int pairs, int, int) override
    {
        at::Generator generator = at::detail::createCPUGenerator(static_cast<std::uint64_t>(step));
        Batch batch;
        batch.source = torch::empty({ pairs, 3, 16, 16 }).uniform_(0.2, 0.9, generator);
        const torch::Tensor dark = torch::empty({ pairs, 1, 1, 1 }).bernoulli_(0.5, generator);
        batch.reference = torch::empty({ pairs, 3, 16, 16 }).uniform_(0.2, 0.9, generator) * (1 - 0.8 * dark);
        const torch::Tensor error = torch::empty({ pairs, 1, 1, 1 }).normal_(0, 1, generator);
        batch.truth = torch::full({ pairs, 3, 16, 16 }, 0.02) * (error * (0.05 + 0.45 * dark)).exp();
        return batch;
    }
};

/// A hundred of them, unlike those that a fit takes, and the ln deviations that the network tells of them.
struct ToldDeviations {
    Batch batch;
    torch::Tensor logs;

    explicit ToldDeviations(Network& network)
    {
        const torch::NoGradGuard no_gradient;
        batch = UnsurePairs().batch(999, 0, 100, 0, 0);
        ChosenParameters choice;
        network.reverse(batch.source, batch.reference, &choice);
        logs = choice.log_deviation;
    }
};

AnchorFitSettings unsure_settings()
{
    AnchorFitSettings settings;
    settings.pairs = 6000;
    settings.steps = 600;
    return settings;
}

TEST_CASE("the anchor says how sure it is: as unsure as it errs, and by what it sees")
{
    UnsurePairs pairs;
    Network network({}, 1);
    REQUIRE(start_anchor(network, pairs, unsure_settings(), 5));
    const ToldDeviations told(network);
    REQUIRE(told.logs.sizes() == at::IntArrayRef({ 100 }));
    const torch::Tensor deviations = told.logs.exp();
    const torch::Tensor dark = told.batch.reference.mean(at::IntArrayRef{ 1, 2, 3 }) < 0.3;
    CHECK(deviations.masked_select(dark).mean().item<double>() == doctest::Approx(0.5).epsilon(0.15));
    CHECK(deviations.masked_select(dark.logical_not()).mean().item<double>() < 0.1);
}

TEST_CASE("how sure an anchor is can be fitted again, after it was changed")
{
    UnsurePairs samples;
    Network network({}, 1);
    REQUIRE(start_anchor(network, samples, unsure_settings(), 5));
    {
        const torch::NoGradGuard no_gradient;
        network.anchor_parameters()[1].add_(1); // e times too bright
    }
    std::optional<AnchorPairs> pairs = pairs_for_anchor(network, unsure_settings());
    REQUIRE(pairs);
    while (!pairs->complete())
        pairs->make_more(samples);
    fit_anchor_deviation(network, *pairs, 5);
    CHECK(ToldDeviations(network).logs.exp().mean().item<double>() == doctest::Approx(1.1).epsilon(0.1));
}
