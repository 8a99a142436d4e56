// SPDX-License-Identifier: Apache-2.0
#include "train/network/network.h"

#include <doctest/doctest.h>
#include <torch/cuda.h>

#include "lib/train/tensor_tools.h"

using namespace srisp::train;

namespace {

struct Variant {
    const char* name;
    ModelSettings settings;
};

/// The full model and every ablation, with the method each needs.
std::vector<Variant> variants()
{
    std::vector<Variant> all(10);
    all[0].name = "full";
    all[1].name = "paper";
    all[1].settings.encoder_input = "plain";
    all[1].settings.statistics = all[1].settings.anchor = false;
    all[2].name = "static selection";
    all[2].settings.selection = "static";
    all[3].name = "merged gain";
    all[3].settings.gain = "merged";
    all[4].name = "static tone";
    all[4].settings.tone = "static";
    all[5].name = "pointwise";
    all[5].settings.kernel_size = "1";
    all[6].name = "intermediate selection";
    all[6].settings.selection = "intermediate";
    all[7].name = "mbispld";
    all[7].settings.method = "mbispld";
    all[8].name = "static selection, merged gain";
    all[8].settings.selection = "static";
    all[8].settings.gain = "merged";
    all[8].settings.anchor = false;
    all[9].name = "one atom";
    all[9].settings.dictionary_size = 1;
    return all;
}

/// As in training: both passes, in one loss.
torch::Tensor loss_of(Unprocessor& model)
{
    const torch::Tensor source = smooth_images(3, 32, 40, 1), reference = smooth_images(3, 24, 24, 2, 0, 0.4);
    const torch::Tensor truth = smooth_images(3, 32, 40, 3, 0, 0.6);
    ChosenParameters choice;
    const torch::Tensor reversed = model.reverse(source, reference, &choice);
    return (reversed - truth).abs().mean() + (model.process(truth, choice) - source).abs().mean();
}

} // namespace

TEST_CASE("every ablation runs, stays within 0 and 1, and gives every parameter but the anchor's a gradient")
{
    for (const Variant& variant : variants()) {
        INFO(variant.name);
        Network network(variant.settings, 7);
        loss_of(network).backward();
        for (const auto& item : network.named_parameters()) {
            INFO(item.key());
            const torch::Tensor gradient = item.value().grad();
            const bool fitted = item.key().find("anchor") == 0;
            REQUIRE(gradient.defined() != fitted);
            if (fitted)
                continue;
            CHECK(torch::isfinite(gradient).all().item<bool>());
            // With one atom its weight is 1, whatever the selection says.
            const bool selects = item.key().find("dictionary.") == std::string::npos;
            if (variant.settings.dictionary_size > 1 || !selects)
                CHECK(largest(gradient) > 0);
        }
    }
}

TEST_CASE("a network starts near the identity tone map and within the hull of its atoms")
{
    const torch::NoGradGuard no_gradient;
    Network network({}, 3);
    const torch::Tensor source = smooth_images(2, 48, 48, 1), reference = smooth_images(2, 48, 48, 2, 0, 0.3);
    ChosenParameters choice;
    Trace trace;
    network.traced_reverse(source, reference, choice, &trace);
    CHECK(largest(trace.at("after_tone") - source) < 0.1);
    CHECK(choice.gamma.min().item<double>() >= 1.6);
    CHECK(choice.gamma.max().item<double>() <= 3.2);
    CHECK(largest(choice.color.sum(2) - 1) < 1e-5);
    // The anchor starts as gain match, the atoms as corrections within e^±0.9.
    const torch::Tensor correction = (choice.gain / choice.base.select(1, 1)).log();
    CHECK(largest(correction) <= 0.9);
    for (const auto& [name, weights] : choice.weights) {
        INFO(name);
        CHECK(largest(weights.sum(1) - 1) < 1e-5);
    }
}

TEST_CASE("3x3 kernels start as the pointwise ones, with nothing around them, and learn their neighbours")
{
    ModelSettings settings;
    settings.kernel_size = "1";
    Network pointwise(settings, 3), spatial({}, 3);
    loss_of(spatial).backward();
    for (int l = 0; l < 4; ++l) {
        CAPTURE(l);
        const std::string name = "dictionary.tone_reverse." + std::to_string(l) + ".weight";
        const torch::Tensor kernels = spatial.named_parameters()[name];
        const torch::Tensor middle = pointwise.named_parameters()[name];
        CHECK(torch::equal(kernels, torch::constant_pad_nd(middle, { 1, 1, 1, 1 })));
        CHECK(largest(kernels.grad().select(-1, 0)) > 0);
    }
}

TEST_CASE("reverse is the choice applied, and each image of a batch is treated by itself")
{
    const torch::NoGradGuard no_gradient;
    for (const Variant& variant : variants()) {
        INFO(variant.name);
        Network network(variant.settings, 5);
        const torch::Tensor source = smooth_images(3, 40, 32, 4), reference = smooth_images(3, 32, 32, 5, 0, 0.5);
        ChosenParameters choice;
        const torch::Tensor together = network.reverse(source, reference, &choice);
        CHECK(together.min().item<double>() >= 0);
        CHECK(together.max().item<double>() <= 1);
        CHECK(largest(network.apply_reverse(source, choice) - together) < 1e-5);
        const torch::Tensor alone = network.reverse(source.slice(0, 1, 2), reference.slice(0, 1, 2));
        CHECK(largest(alone - together.slice(0, 1, 2)) < 1e-5);
    }
}

TEST_CASE("the same seed gives the same network, another seed another one")
{
    const Network a({}, 11), b({}, 11), c({}, 12);
    bool differs = false;
    for (const auto& item : a.named_parameters()) {
        CHECK(torch::equal(item.value(), b.named_parameters()[item.key()]));
        differs = differs || !torch::equal(item.value(), c.named_parameters()[item.key()]);
    }
    CHECK(differs);
}

TEST_CASE("constrain brings back atoms that make no sense, and leaves others alone")
{
    Network network({}, 1);
    const auto before = network.named_parameters()["dictionary.gain"].clone();
    {
        const torch::NoGradGuard no_gradient;
        auto parameters = network.named_parameters();
        parameters["dictionary.gamma"][0] = -1;
        parameters["dictionary.white_balance"][1][0] = 0;
        parameters["dictionary.color"][2] = torch::ones({ 3, 3 }); // singular
        parameters["dictionary.color"][3].mul_(5);                 // rows sum to 5
    }
    for (int i = 0; i < 10; ++i)
        network.constrain();
    const auto parameters = network.named_parameters();
    CHECK(parameters["dictionary.gamma"].min().item<double>() > 0);
    CHECK(parameters["dictionary.white_balance"].min().item<double>() > 0);
    CHECK(torch::det(parameters["dictionary.color"]).min().item<double>() > 1e-2);
    CHECK(largest(parameters["dictionary.color"].sum(2) - 1) < 1e-5);
    CHECK(torch::equal(parameters["dictionary.gain"], before));
}

TEST_CASE("colour atoms may be given, and are completed where there are too few")
{
    ModelSettings settings;
    settings.initial_color = { { 2, -1, 0, 0, 2, -1, -1, 0, 2 }, { 1, 0, 0, 0, 1, 0, 0, 0, 1 } };
    const Network network(settings, 1);
    const torch::Tensor color = network.named_parameters()["dictionary.color"];
    REQUIRE(color.size(0) == 5);
    CHECK(color[0][0][0].item<float>() == 2);
    CHECK(torch::equal(color[1], torch::eye(3)));
    for (int a = 0; a < 5; ++a)
        for (int b = 0; b < a; ++b)
            CHECK(largest(color[a] - color[b]) > 1e-3);
}

TEST_CASE("on the device that training takes, a GPU where there is one, a network computes what it does on the CPU")
{
    const torch::NoGradGuard no_gradients;
    Network network({}, 1);
    const torch::Tensor photo = smooth_images(3, 64, 64, 4, 0.2, 0.9), raw = smooth_images(3, 64, 64, 5, 0.02, 0.3);
    const torch::Tensor expected = network.reverse(photo, raw);
    const torch::Device device = torch::cuda::is_available() ? torch::kCUDA : torch::kCPU;
    network.to(device);
    const torch::Tensor actual = network.reverse(photo.to(device), raw.to(device)).cpu();
    CHECK((actual - expected).abs().max().item<double>() < 2e-3); // GPUs round factors to TF32
}
