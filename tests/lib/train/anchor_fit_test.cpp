// SPDX-License-Identifier: Apache-2.0
#include "anchor_fit.h"

#include <doctest/doctest.h>

#include "image_statistics.h"
#include "network.h"
#include "tensor_tools.h"

using namespace srisp::train;

namespace {

double largest(const torch::Tensor& tensor)
{
    return tensor.abs().max().item<double>();
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
    // Log means above ln 1e-3, where they are not cut off.
    const torch::Tensor means = torch::addmm(bias, statistics, weight.t()).exp();
    REQUIRE(means.min().item<double>() > 1e-3);
    const AnchorFit fit = fit_anchor(statistics, means, 0);
    CHECK(largest(fit.weight - weight) < 1e-4);
    CHECK(largest(fit.bias - bias) < 1e-4);
    CHECK(fit.deviation < 1e-5);
    const AnchorFit shrunk = fit_anchor(statistics, means, 10);
    CHECK(shrunk.weight.norm().item<double>() < 0.5 * fit.weight.norm().item<double>());
}

TEST_CASE("a model's anchor is fitted to its training pairs and then predicts their brightness")
{
    Network network({}, 1);
    SimplePairs pairs;
    const std::optional<AnchorFit> fit = start_anchor(network, pairs, { 500, 1e-6 });
    REQUIRE(fit);
    CHECK(fit->gain_match_deviation == doctest::Approx(std::log(3)).epsilon(0.01));
    CHECK(fit->deviation < 0.02);

    const Batch batch = pairs.batch(99, 0, 8, 0, 0);
    const torch::Tensor statistics =
        torch::cat({ source_statistics(batch.source), image_statistics(batch.reference) }, 1);
    const auto parameters = network.named_parameters();
    const torch::Tensor predicted =
        torch::addmm(parameters["anchor.bias"], statistics, parameters["anchor.weight"].t());
    CHECK(largest(predicted - batch.truth.mean({ 2, 3 }).log()) < 0.1);
}

TEST_CASE("a model without an anchor is left alone")
{
    ModelSettings settings;
    settings.anchor = false;
    Network network(settings, 1);
    SimplePairs pairs;
    CHECK(!start_anchor(network, pairs, { 64, 1e-3 }));
}
