// SPDX-License-Identifier: Apache-2.0
#include "shown_images.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "metric_table.h"

namespace srisp::tool {

namespace {

constexpr std::size_t kWorst = 10;

/// Higher is better; what was not measured comes last.
double goodness(const Evaluation& evaluation, const ImageScore& image)
{
    const auto method = image.methods.find(evaluation.methods.back());
    if (method == image.methods.end())
        return std::numeric_limits<double>::infinity();
    const auto value = method->second.values.find(evaluation.has_truth ? key::kPsnr : key::kLab);
    const double number = value == method->second.values.end() ? std::nan("") : value->second.value();
    return std::isfinite(number) ? number : std::numeric_limits<double>::infinity();
}

} // namespace

std::vector<std::size_t> shown_images(const Evaluation& evaluation, std::size_t most)
{
    std::vector<std::size_t> order(evaluation.images.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return goodness(evaluation, evaluation.images[a]) < goodness(evaluation, evaluation.images[b]);
    });
    if (order.size() <= most)
        return order;
    const std::size_t worst = std::min(kWorst, most), others = most - worst, rest = order.size() - worst;
    std::vector<std::size_t> shown(order.begin(), order.begin() + std::ptrdiff_t(worst));
    for (std::size_t i = 0; i < others; ++i)
        shown.push_back(order[worst + (2 * i + 1) * rest / (2 * others)]);
    return shown;
}

int picture_side(std::size_t images, std::size_t shown, std::size_t methods, double megabytes)
{
    // Measured on photos: bytes a pixel of a linear picture and of a JPEG, of which a third is added where they are
    // embedded, and bytes that the page has for each image.
    constexpr double kLinear = 3.8, kJpeg = 0.5, kEmbedded = 0.75, kPage = 4000, kShape = 0.75;
    constexpr int kLeast = 64, kMost = 320;
    const double for_pictures = std::max(megabytes * 1e6 - kPage * double(images), 0.0) * kEmbedded;
    const double pixels =
        for_pictures / double(std::max<std::size_t>(shown, 1)) / (kLinear * double(methods + 2) + kJpeg);
    return std::clamp(int(std::sqrt(pixels / kShape)), kLeast, kMost);
}

} // namespace srisp::tool
