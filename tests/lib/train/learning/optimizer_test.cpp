// SPDX-License-Identifier: Apache-2.0
#include "train/learning/optimizer.h"

#include <doctest/doctest.h>
#include <torch/torch.h>

using namespace srisp::train;

TEST_CASE("Adam on one vector is LibTorch's Adam, with a rate for dictionaries and a limit on the gradient")
{
    const auto make = [] {
        torch::manual_seed(1);
        return torch::nn::Linear(4, 3);
    };
    torch::nn::Linear ours = make(), theirs = make();
    ParameterVector parameters(*ours);
    OptimizerSettings settings;
    settings.rate = 0.01;
    settings.dictionary_rate = 0.05;
    settings.clip_norm = 0.5;
    const torch::Tensor none = torch::zeros_like(parameters.values());
    Adam adam(settings, parameters, parameters.mask_of({ ours->bias }), none);
    torch::optim::Adam reference(
        { torch::optim::OptimizerParamGroup({ theirs->weight },
                                            std::make_unique<torch::optim::AdamOptions>(settings.rate)),
          torch::optim::OptimizerParamGroup({ theirs->bias },
                                            std::make_unique<torch::optim::AdamOptions>(settings.dictionary_rate)) },
        torch::optim::AdamOptions(settings.rate));
    for (int step = 0; step < 20; ++step) {
        const torch::Tensor input = torch::randn({ 5, 4 });
        parameters.gradients().zero_();
        ours(input).pow(2).sum().backward();
        adam.update(step, 1, adam.gradient_norm());
        reference.zero_grad();
        theirs(input).pow(2).sum().backward();
        torch::nn::utils::clip_grad_norm_(theirs->parameters(), settings.clip_norm);
        reference.step();
        CHECK(torch::allclose(ours->weight, theirs->weight, 1e-4, 1e-6));
        CHECK(torch::allclose(ours->bias, theirs->bias, 1e-4, 1e-6));
    }
}

TEST_CASE("weight decay shrinks matrices and leaves biases and dictionaries")
{
    torch::nn::Linear layer(4, 3);
    const torch::Tensor weight = layer->weight.detach().clone(), bias = layer->bias.detach().clone();
    ParameterVector parameters(*layer);
    OptimizerSettings settings;
    settings.rate = 0.1;
    settings.weight_decay = 0.5;
    Adam adam(settings, parameters, parameters.mask_of({ layer->bias }), torch::ones_like(parameters.values()));
    parameters.gradients().zero_();
    adam.update(0, 1, 0);
    CHECK(torch::allclose(layer->weight, weight * 0.95));
    CHECK(torch::equal(layer->bias, bias));
}

TEST_CASE("a module's parameters are views of one vector")
{
    torch::nn::Linear layer(2, 1);
    ParameterVector parameters(*layer);
    CHECK(parameters.layout() == "weight[1, 2] bias[1]");
    parameters.values().fill_(3);
    CHECK(layer->weight[0][1].item<double>() == 3);
    layer(torch::ones({ 1, 2 })).sum().backward();
    CHECK(parameters.gradients().sum().item<double>() == 3);
    CHECK(torch::equal(parameters.mask_of({ layer->bias }), torch::tensor({ 0.f, 0.f, 1.f })));
}

TEST_CASE("learning rates follow their schedules")
{
    OptimizerSettings settings;
    settings.warm_up = 0.1;
    settings.final_factor = 0.01;
    settings.schedule = "one_cycle";
    CHECK(rate_factor(settings, 0, 1000) == doctest::Approx(0.04));
    CHECK(rate_factor(settings, 50, 1000) == doctest::Approx(0.52));
    CHECK(rate_factor(settings, 100, 1000) == doctest::Approx(1));
    CHECK(rate_factor(settings, 550, 1000) == doctest::Approx(0.505));
    CHECK(rate_factor(settings, 1000, 1000) == doctest::Approx(0.01));
    settings.schedule = "cosine";
    CHECK(rate_factor(settings, 0, 1000) == doctest::Approx(1));
    CHECK(rate_factor(settings, 500, 1000) == doctest::Approx(0.505));
    settings.schedule = "step";
    CHECK(rate_factor(settings, 312, 1000) == 1);
    CHECK(rate_factor(settings, 313, 1000) == 0.1);
    CHECK(rate_factor(settings, 625, 1000) == 0.01);
    settings.schedule = "constant";
    CHECK(rate_factor(settings, 999, 1000) == 1);
}
