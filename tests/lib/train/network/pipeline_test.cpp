// SPDX-License-Identifier: Apache-2.0
#include "train/network/pipeline.h"

#include <doctest/doctest.h>

#include "lib/train/tensor_tools.h"

using namespace srisp::train;

namespace {

torch::Tensor pixel(float r, float g, float b)
{
    return torch::tensor({ r, g, b }).view({ 1, 3, 1, 1 });
}

/// Result and gradient of an input, for a weighting of the results that tells all of them apart.
template<class Function> std::pair<torch::Tensor, torch::Tensor> evaluate(const torch::Tensor& x, Function function)
{
    const torch::Tensor input = x.detach().clone().requires_grad_();
    const torch::Tensor result = function(input);
    (result * torch::arange(result.numel()).view_as(result)).sum().backward();
    return { result.detach(), input.grad() };
}

} // namespace

TEST_CASE("the inverse gain keeps highlights: golden values of method.md")
{
    const torch::Tensor gains = torch::tensor({ { 1.25f * 2, 1.25f, 1.25f * 1.6f } });
    CHECK(largest(inverse_gain(pixel(.2f, .4f, .6f), gains) - pixel(.08f, .32f, .3f)) < 1e-6);
    CHECK(largest(inverse_gain(pixel(.95f, .95f, .95f), gains) - pixel(.5225f, .8075f, .59375f)) < 1e-6);
    CHECK(largest(inverse_gain(pixel(1, 1, 1), gains) - pixel(1, 1, 1)) < 1e-6);
}

TEST_CASE("gains below 1 are inverted as they are, without a highlight mask")
{
    const torch::Tensor bright = pixel(.95f, .97f, .99f), gains = torch::full({ 1, 1 }, 0.5);
    CHECK(largest(inverse_gain(bright, gains) - 2 * bright) < 1e-6);
}

TEST_CASE("a batch of matrices is inverted")
{
    const torch::Tensor matrices =
        torch::empty({ 20, 3, 3 }).uniform_(-1, 1, at::detail::createCPUGenerator(1)) + 2 * torch::eye(3);
    const torch::Tensor product = torch::matmul(inverse3x3(matrices), matrices);
    CHECK(largest(product - torch::eye(3)) < 1e-5);
}

TEST_CASE("candidates are the blocks applied atom by atom")
{
    const torch::Tensor image = smooth_images(2, 9, 11, 1);
    const torch::Tensor gamma = torch::tensor({ 1.7f, 2.5f, 3.1f });
    const torch::Tensor matrices = row_normalized(torch::eye(3) + 0.1 * torch::rand({ 3, 3, 3 }));
    const torch::Tensor gains = 0.5 + torch::rand({ 2, 3, 3 });
    for (int k = 0; k < 3; ++k) {
        CHECK(largest(power_candidates(image, gamma).select(1, k) - power(image, gamma[k].expand({ 2 }))) < 1e-6);
        CHECK(largest(color_candidates(image, matrices).select(1, k) -
                      color_transform(image, matrices[k].expand({ 2, 3, 3 }))) < 1e-6);
        CHECK(largest(inverse_gain_candidates(image, gains).select(1, k) - inverse_gain(image, gains.select(1, k))) <
              1e-6);
    }
}

TEST_CASE("powers are within 1e-6 of the exact ones, and the encoders' scaling too")
{
    const torch::Tensor image =
        torch::cat({ torch::linspace(0, 1, 2999), torch::logspace(-7, 0, 1501) }).view({ 1, 3, 1, -1 });
    const torch::Tensor exact = image.to(torch::kFloat64).clamp_min(1e-8);
    for (const float exponent : { 0.3f, 1 / 2.2f, 1.f, 1.6f, 2.2f, 3.2f }) {
        const torch::Tensor expected = exact.pow(static_cast<double>(exponent));
        CHECK(largest(power(image, torch::full({ 1 }, exponent)) / expected - 1) < 5e-6);
        CHECK(largest(power(image, torch::full({ 1 }, exponent)) - expected) < 1e-6);
    }
    CHECK(largest(perceptual(image) - (image.to(torch::kFloat64).clamp_min(1e-5).pow(1 / 2.2) - 0.3)) < 1e-6);
}

TEST_CASE("ReLU and border in one are ReLU and border after each other, gradients included")
{
    for (const auto& [rows, columns] : { std::pair(7, 5), std::pair(1, 4), std::pair(3, 1), std::pair(2, 2) }) {
        INFO(rows, " x ", columns);
        const torch::Tensor x =
            torch::empty({ 2, 3, rows, columns }).uniform_(-1, 1, at::detail::createCPUGenerator(1));
        const auto [result, gradient] = evaluate(x, relu_with_border);
        const auto [expected, expected_gradient] = evaluate(x, [](const torch::Tensor& v) {
            return torch::replication_pad2d(torch::relu(v), { 1, 1, 1, 1 });
        });
        CHECK(torch::equal(result, expected));
        CHECK(torch::allclose(gradient, expected_gradient, 1e-6, 1e-3));
    }
}

TEST_CASE("ReLU with border hides no NaN")
{
    CHECK(relu_with_border(torch::full({ 1, 1, 2, 2 }, std::nan(""))).isnan().all().item<bool>());
}
