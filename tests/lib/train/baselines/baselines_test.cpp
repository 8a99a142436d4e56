// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "lib/train/tensor_tools.h"
#include "rendering/upi.h"
#include "train/baselines/baselines.h"
#include "train/run/model_file.h"
#include "train/tensors/color.h"

using namespace srisp::train;

namespace {

std::shared_ptr<Unprocessor> baseline(const std::string& method, std::uint64_t seed = 1)
{
    ModelSettings settings;
    settings.method = method;
    return make_unprocessor(settings, seed);
}

} // namespace

TEST_CASE("gain match gives the reference's channel means, and its forward pass takes them back")
{
    const torch::Tensor source = smooth_images(2, 20, 30, 1, 0.1, 0.9);
    const torch::Tensor reference = smooth_images(2, 16, 16, 2, 0.05, 0.2);
    ChosenParameters choice;
    const auto method = baseline("gain_match");
    const torch::Tensor raw = method->reverse(source, reference, &choice);
    CHECK(largest(raw.mean({ 2, 3 }) - reference.mean({ 2, 3 })) < 1e-5);
    CHECK(largest(method->process(raw, choice) - source) < 1e-4);
}

TEST_CASE("UPI's constants are those of method.md")
{
    CHECK(inverse_smoothstep(torch::tensor({ 0.1 })).item<double>() == doctest::Approx(0.1958001).epsilon(1e-6));
    CHECK(inverse_smoothstep(torch::tensor({ 0.75 })).item<double>() == doctest::Approx(0.6736482).epsilon(1e-6));
    const torch::Tensor expected =
        torch::tensor({ .826379, .295062, -.121440, .109196, .917753, -.026949, .035224, .244491, .720284 })
            .view({ 3, 3 });
    CHECK(largest(dnd_rgb_to_camera()[0] - expected) < 2e-6);
}

TEST_CASE("UPI draws other parameters for every image, the same for the same seed, and inverts itself")
{
    const torch::Tensor source = smooth_images(4, 20, 20, 1, 0.05, 0.7);
    ChosenParameters first, again, other;
    const auto method = baseline("upi", 5);
    const torch::Tensor raw = method->reverse(source, {}, &first);
    baseline("upi", 5)->reverse(source, {}, &again);
    baseline("upi", 6)->reverse(source, {}, &other);
    CHECK(torch::equal(first.white_balance, again.white_balance));
    CHECK(!torch::equal(first.white_balance, other.white_balance));
    CHECK(!torch::equal(first.color[0], first.color[1]));
    CHECK(raw.min().item<double>() >= 0);
    // Where no colour leaves the camera's gamut, the forward pass takes the reverse back.
    const torch::Tensor grey = torch::linspace(0.02, 0.8, 64).view({ 1, 1, 8, 8 }).repeat({ 4, 3, 1, 1 });
    CHECK(largest(method->process(method->apply_reverse(grey, first), first) - grey) < 1e-3);
}

TEST_CASE("UPI without LibTorch gives the same pixels")
{
    const torch::Tensor source = smooth_images(1, 20, 20, 1, 0, 1);
    ChosenParameters choice;
    const torch::Tensor raw = baseline("upi", 5)->reverse(source, {}, &choice);
    const srisp::UpiParameters parameters = srisp::draw_upi(srisp::Random(5, 0));
    double worst = 0;
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) {
            srisp::Vector3 photo;
            for (int c = 0; c < 3; ++c)
                photo[c] = source[0][c][y][x].item<float>();
            const srisp::Vector3 v = srisp::unprocessed_by_upi(parameters, photo);
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst, std::fabs(v[c] - raw[0][c][y][x].item<double>()));
        }
    CHECK(worst < 1e-5);
}

TEST_CASE("the U-Net takes any size, looks at no reference, and learns")
{
    const auto method = baseline("unet");
    const torch::Tensor source = smooth_images(2, 37, 50, 1);
    const torch::Tensor raw = method->reverse(source, {});
    CHECK(raw.sizes() == source.sizes());
    CHECK(raw.min().item<double>() > 0);
    CHECK(raw.max().item<double>() < 1);
    CHECK(!method->process(raw, {}).defined());
    raw.mean().backward();
    for (const auto& item : method->named_parameters()) {
        INFO(item.key());
        CHECK(largest(item.value().grad()) > 0);
    }
}

TEST_CASE("MBISPLD ignores the reference; gain and white balance are one")
{
    const torch::NoGradGuard no_gradient;
    const auto method = baseline("mbispld");
    const torch::Tensor source = smooth_images(2, 24, 24, 1);
    ChosenParameters choice;
    const torch::Tensor raw = method->reverse(source, smooth_images(2, 24, 24, 2), &choice);
    CHECK(torch::equal(raw, method->reverse(source, smooth_images(2, 24, 24, 3))));
    CHECK(torch::equal(choice.gain, torch::ones({ 2 })));
    CHECK(largest(choice.white_balance.select(1, 1) - 1) > 0.01);
    CHECK(choice.gamma[0].item<float>() == choice.gamma[1].item<float>());
    for (const auto& item : method->named_parameters())
        CHECK(item.key().find("reference") == std::string::npos);
}
