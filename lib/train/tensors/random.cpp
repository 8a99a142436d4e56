// SPDX-License-Identifier: Apache-2.0
#include "train/tensors/random.h"

#include <cmath>

#include "train/tensors/resize.h"

namespace srisp::train {

namespace {

/// [size, knots]: cubic B-splines whose knots span the axis.
torch::Tensor spline_weights(std::int64_t size, int cells)
{
    auto weights = torch::zeros({ size, cells + 3 });
    auto weight = weights.accessor<float, 2>();
    for (std::int64_t i = 0; i < size; ++i) {
        const double position = (i + 0.5) / size * cells;
        const int cell = static_cast<int>(position);
        const double t = position - cell;
        const double basis[] = { std::pow(1 - t, 3) / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
                                 (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6 };
        for (int k = 0; k < 4; ++k)
            weight[i][cell + k] = static_cast<float>(basis[k]);
    }
    return weights;
}

} // namespace

Randoms fork(const Randoms& randoms, std::uint64_t purpose)
{
    Randoms forks;
    for (const Random& random : randoms)
        forks.push_back(random.fork(purpose));
    return forks;
}

torch::Tensor noise(Randoms& randoms, at::IntArrayRef sizes)
{
    std::vector<std::int64_t> shape = { static_cast<std::int64_t>(randoms.size()) };
    shape.insert(shape.end(), sizes.begin(), sizes.end());
    const auto values = torch::empty(shape);
    const std::int64_t count = randoms.empty() ? 0 : values.numel() / shape[0];
    // Four numbers of 16 bits: their sum has mean 2 · 65535 and variance 4 (65536² − 1) / 12.
    const float scale = static_cast<float>(1 / std::sqrt((65536.0 * 65536.0 - 1) / 3));
    float* value = values.data_ptr<float>();
    for (Random& random : randoms)
        for (std::int64_t i = 0; i < count; ++i) {
            const std::uint64_t bits = random.bits();
            const auto sum = (bits & 0xffff) + (bits >> 16 & 0xffff) + (bits >> 32 & 0xffff) + (bits >> 48);
            *value++ = (static_cast<float>(sum) - 131070.0f) * scale;
        }
    return values;
}

torch::Tensor smooth_fields(Randoms& randoms, std::int64_t height, std::int64_t width, const torch::Device& device)
{
    // Eight cells need no more samples than these; in between a cubic will do, and it is far cheaper.
    constexpr int kSamples = 32;
    torch::Tensor field;
    double strength = 1;
    for (int cells = 1; cells <= 8; cells *= 2, strength *= 0.6) {
        const auto knots = noise(randoms, { cells + 3, cells + 3 });
        // One product for each image: matmul would make one of all, whose last bits some processors let depend on how
        // many images there are.
        const auto weights = spline_weights(kSamples, cells).expand({ knots.size(0), -1, -1 });
        const auto octave = torch::bmm(weights, torch::bmm(knots, weights.transpose(1, 2))).unsqueeze(1);
        field = field.defined() ? field + strength * octave : octave;
    }
    field = field - field.mean({ 2, 3 }, true);
    field = field / field.square().mean({ 2, 3 }, true).sqrt().clamp_min(1e-6);
    return enlarge(field.to(device), height, width);
}

} // namespace srisp::train
