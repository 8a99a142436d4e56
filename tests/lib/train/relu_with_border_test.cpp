// SPDX-License-Identifier: Apache-2.0
#include "relu_with_border.h"

#include <doctest/doctest.h>

using namespace srisp::train;

namespace {

/// Result and gradient of an input, for a weighting of the results that tells all of them apart.
template<class Function> std::pair<torch::Tensor, torch::Tensor> evaluate(const torch::Tensor& x, Function function)
{
    const torch::Tensor input = x.detach().clone().requires_grad_();
    const torch::Tensor result = function(input);
    (result * torch::arange(result.numel()).view_as(result)).sum().backward();
    return { result.detach(), input.grad() };
}

} // namespace

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
