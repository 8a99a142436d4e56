// SPDX-License-Identifier: Apache-2.0
#include "train/learning/losses.h"

namespace srisp::train {

namespace {

constexpr double kWhite = 0.98;    // every channel of the photo at or above it
constexpr double kShortest = 1e-3; // of a pixel's vector: the colour of what is darker does not matter

torch::Tensor mean_per_image(const torch::Tensor& images)
{
    return images.flatten(1).mean(1);
}

/// Mean over the elements where `mask` is 1; 0 for an image that has none.
torch::Tensor masked_mean(const torch::Tensor& images, const torch::Tensor& mask)
{
    return (images * mask).flatten(1).sum(1) / mask.expand_as(images).flatten(1).sum(1).clamp_min(1);
}

torch::Tensor directions(const torch::Tensor& images)
{
    return images / (images.square().sum(1, true) + kShortest * kShortest).sqrt();
}

} // namespace

torch::Tensor log_means(const torch::Tensor& images)
{
    return images.mean({ 2, 3 }).clamp_min(kDarkestMean).log();
}

torch::Tensor means_of(const torch::Tensor& images)
{
    return torch::stack(
        { log_means(images), images.square().mean({ 2, 3 }), (images * (images > kHighlight)).mean({ 2, 3 }) }, 1);
}

torch::Tensor cost_of_means(const torch::Tensor& errors_of_logs, const torch::Tensor& truth)
{
    constexpr double kBrightnessFloor = 0.2 * 0.2, kColorFloor = 0.1 * 0.1, kDarkHighlights = 60;
    const torch::Tensor squares = truth.select(1, 1), highlights = truth.select(1, 2);
    const torch::Tensor missed =
        (squares * torch::expm1(errors_of_logs).square()).sum(1) / squares.sum(1).clamp_min(1e-8);
    const torch::Tensor green = errors_of_logs.select(1, 1);
    const torch::Tensor color =
        (errors_of_logs.select(1, 0) - green).square() + (errors_of_logs.select(1, 2) - green).square();
    const torch::Tensor lost = (highlights * -torch::expm1(errors_of_logs.clamp_max(0))).mean(1);
    return (missed / kBrightnessFloor).log1p() + (color / kColorFloor).log1p() + kDarkHighlights * lost;
}

torch::Tensor brightness_ratio(const torch::Tensor& others, const torch::Tensor& images)
{
    const auto green = [](const torch::Tensor& v) {
        return v.slice(1, 1, 2).mean({ 2, 3 }, true).clamp_min(kDarkestMean);
    };
    return green(others) / green(images);
}

bool needs_round_trip(const LossSettings& settings)
{
    return settings.round_trip > 0 || settings.white > 0;
}

std::vector<LossTerm> loss_terms(const LossSettings& settings, const Compared& images)
{
    std::vector<LossTerm> terms;
    const auto add = [&terms](const char* name, double weight, const auto& values) {
        if (weight > 0)
            terms.push_back({ name, weight, values() });
    };
    const auto encode = [&settings](const torch::Tensor& raw) {
        return raw.clamp_min(settings.floor).pow(1 / settings.gamma);
    };
    const torch::Tensor matched =
        settings.brightness_matched ? (images.predicted * brightness_ratio(images.truth, images.predicted)).clamp_max(1)
                                    : images.predicted;
    add("reverse", settings.reverse, [&] { return mean_per_image((encode(images.truth) - encode(matched)).abs()); });
    if (images.processed.defined())
        add("forward", settings.forward, [&] { return mean_per_image((images.source - images.processed).abs()); });
    add("linear", settings.linear, [&] { return mean_per_image((matched - images.truth).abs()); });
    add("means", settings.means, [&] {
        const torch::Tensor truth = means_of(images.truth), log_truth = truth.select(1, 0);
        torch::Tensor errors = log_means(images.predicted) - log_truth;
        if (images.expected_means.defined())
            errors = errors - (images.expected_means - log_truth).slice(1, 1, 2);
        return cost_of_means(errors, truth);
    });
    add("angle", settings.angle, [&] {
        const torch::Tensor difference = directions(images.truth) - directions(images.predicted);
        return mean_per_image((difference.square().sum(1) + 1e-8).sqrt());
    });
    add("highlights", settings.highlights, [&] {
        return masked_mean((images.truth - matched).clamp_min(0), (images.truth > kHighlight).to(torch::kFloat));
    });
    if (images.round_trip.defined()) {
        const auto change = [&images] { return (images.source - images.round_trip).abs(); };
        add("round_trip", settings.round_trip, [&] { return mean_per_image(change()); });
        add("white", settings.white,
            [&] { return masked_mean(change(), (images.source.amin(1, true) >= kWhite).to(torch::kFloat)); });
    }
    return terms;
}

} // namespace srisp::train
