// SPDX-License-Identifier: Apache-2.0
#include "train/network/pipeline.h"

#include <algorithm>

#include <ATen/Parallel.h>

namespace srisp::train {

namespace {

constexpr double kPowerFloor = 1e-8, kPerceptualFloor = 1e-5;

/// torch::pow computes a second power for its gradient, and for a tensor exponent a logarithm too; this reuses its
/// result. For values in [0, 1] it errs by 1e-6 relative at most.
torch::Tensor floored_log(const torch::Tensor& image)
{
    return torch::log(image.clamp_min(kPowerFloor));
}

/// v · max(m + (1 − m) s, s) = v s + v m · max(1 − s, 0), with a mask m that does not depend on the gains.
torch::Tensor preserved_highlights(const torch::Tensor& image)
{
    const torch::Tensor mask = ((image.mean(1, true) - 0.9) * 10).clamp(0, 1).square();
    return image * mask;
}

/// One channel: rows × columns become (rows + 2) × (columns + 2).
void forward_plane(const float* in, float* out, std::int64_t rows, std::int64_t columns)
{
    const std::int64_t stride = columns + 2;
    for (std::int64_t y = 0; y < rows; ++y, in += columns) {
        float* const row = out + (y + 1) * stride;
        for (std::int64_t x = 0; x < columns; ++x)
            row[x + 1] = in[x] < 0 ? 0 : in[x]; // NaN stays NaN
        row[0] = row[1];
        row[columns + 1] = row[columns];
    }
    std::copy_n(out + stride, stride, out);
    std::copy_n(out + rows * stride, stride, out + (rows + 1) * stride);
}

/// Gradients of the border go to the pixels that it replicates; `out` is what forward_plane wrote.
void backward_plane(const float* out, const float* out_gradient, float* gradient, std::int64_t rows,
                    std::int64_t columns)
{
    const std::int64_t stride = columns + 2;
    std::vector<float> sum(static_cast<std::size_t>(stride));
    for (std::int64_t y = 0; y < rows; ++y, gradient += columns) {
        const auto add = [&](std::int64_t padded_row) {
            const float* const row = out_gradient + padded_row * stride;
            for (std::int64_t x = 0; x < stride; ++x)
                sum[x] += row[x];
        };
        std::copy_n(out_gradient + (y + 1) * stride, stride, sum.begin());
        if (y == 0)
            add(0);
        if (y == rows - 1)
            add(rows + 1);
        sum[1] += sum[0];
        sum[columns] += sum[columns + 1];
        const float* const values = out + (y + 1) * stride + 1;
        for (std::int64_t x = 0; x < columns; ++x)
            gradient[x] = values[x] > 0 ? sum[x + 1] : 0;
    }
}

struct ReluWithBorder : torch::autograd::Function<ReluWithBorder> {
    static torch::Tensor forward(torch::autograd::AutogradContext* context, const torch::Tensor& input)
    {
        const torch::Tensor x = input.contiguous();
        const std::int64_t rows = x.size(2), columns = x.size(3);
        torch::Tensor out = torch::empty({ x.size(0), x.size(1), rows + 2, columns + 2 }, x.options());
        const float* const in = x.data_ptr<float>();
        float* const values = out.data_ptr<float>();
        at::parallel_for(0, x.size(0) * x.size(1), 1, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t c = begin; c < end; ++c)
                forward_plane(in + c * rows * columns, values + c * (rows + 2) * (columns + 2), rows, columns);
        });
        context->save_for_backward({ out });
        return out;
    }

    static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                   const torch::autograd::variable_list& gradients)
    {
        const torch::Tensor out = context->get_saved_variables()[0], out_gradient = gradients[0].contiguous();
        const std::int64_t rows = out.size(2) - 2, columns = out.size(3) - 2;
        torch::Tensor gradient = torch::empty({ out.size(0), out.size(1), rows, columns }, out.options());
        const float *const values = out.data_ptr<float>(), *const given = out_gradient.data_ptr<float>();
        float* const result = gradient.data_ptr<float>();
        at::parallel_for(0, out.size(0) * out.size(1), 1, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t c = begin; c < end; ++c) {
                const std::int64_t padded = c * (rows + 2) * (columns + 2);
                backward_plane(values + padded, given + padded, result + c * rows * columns, rows, columns);
            }
        });
        return { gradient };
    }
};

// oneDNN computes 8 outputs three times as fast as 3, with their gradients.
constexpr std::int64_t kFewestOutputs = 8;

/// `x`, [1, N · I, H + 2, W + 2], has its border already; all images go through one grouped convolution.
torch::Tensor convolve_3x3(const torch::Tensor& x, const torch::Tensor& weight, const torch::Tensor& bias)
{
    return torch::conv2d(x, weight.flatten(0, 1), bias.flatten(), torch::IntArrayRef{ 1 }, torch::IntArrayRef{ 0 },
                         torch::IntArrayRef{ 1 }, weight.size(0));
}

/// 1×1 kernels as the middle of 1×3 ones: oneDNN hands the 1×1 grouped convolution to BLAS, and Debian's reference BLAS
/// takes five times as long.
torch::Tensor convolve_1x1(const torch::Tensor& x, const torch::Tensor& weight, const torch::Tensor& bias)
{
    const torch::Tensor wide = torch::constant_pad_nd(weight, { 1, 1 });
    return torch::conv2d(x, wide.flatten(0, 1), bias.flatten(), torch::IntArrayRef{ 1 }, torch::IntArrayRef{ 0, 1 },
                         torch::IntArrayRef{ 1 }, weight.size(0));
}

} // namespace

torch::Tensor power(const torch::Tensor& image, const torch::Tensor& exponent)
{
    return torch::exp(floored_log(image) * exponent.view({ -1, 1, 1, 1 }));
}

torch::Tensor power_candidates(const torch::Tensor& image, const torch::Tensor& gamma)
{
    return torch::exp(floored_log(image).unsqueeze(1) * gamma.view({ 1, -1, 1, 1, 1 }));
}

torch::Tensor color_transform(const torch::Tensor& image, const torch::Tensor& matrix)
{
    return torch::bmm(matrix, image.flatten(2)).view(image.sizes()).clamp(0, 1);
}

torch::Tensor color_candidates(const torch::Tensor& image, const torch::Tensor& matrices)
{
    const std::int64_t images = image.size(0), atoms = matrices.size(0);
    const torch::Tensor all = matrices.view({ 1, atoms * 3, 3 }).expand({ images, atoms * 3, 3 });
    return torch::bmm(all, image.flatten(2)).clamp(0, 1).view({ images, atoms, 3, image.size(2), image.size(3) });
}

torch::Tensor inverse_gain(const torch::Tensor& image, const torch::Tensor& gains)
{
    return inverse_gain_candidates(image, gains.unsqueeze(1)).squeeze(1);
}

torch::Tensor inverse_gain_candidates(const torch::Tensor& image, const torch::Tensor& gains)
{
    const torch::Tensor scale = gains.reciprocal().unsqueeze(-1).unsqueeze(-1);
    return image.unsqueeze(1) * scale + preserved_highlights(image).unsqueeze(1) * torch::relu(1 - scale);
}

torch::Tensor rebuilt_highlights(const torch::Tensor& balanced, const torch::Tensor& gain)
{
    // Results with other gains are not used, but their gradients must be finite.
    const torch::Tensor most = gain.clamp_max(0.999999).reciprocal(), u = torch::minimum(balanced, most);
    const torch::Tensor top = u.amax(1, true).clamp_min(1);
    const torch::Tensor near_white = ((u.clamp_max(1).sum(1, true) - 2.9) * 10).clamp(0, 1);
    const torch::Tensor share = (near_white * (top - 1) / (most - 1)).square();
    return (gain * (u + share * (top - u))).clamp(0, 1);
}

torch::Tensor relu_with_border(const torch::Tensor& x)
{
    if (!x.is_cpu() || x.scalar_type() != torch::kFloat32)
        return torch::replication_pad2d(torch::relu(x), { 1, 1, 1, 1 });
    return ReluWithBorder::apply(x);
}

torch::Tensor apply_tone_map(const torch::Tensor& image, const std::vector<torch::Tensor>& weight,
                             const std::vector<torch::Tensor>& bias)
{
    const std::int64_t images = image.size(0), height = image.size(2), width = image.size(3);
    const bool spatial = weight.front().size(-1) == 3;
    torch::Tensor x = image.reshape({ 1, -1, height, width });
    if (spatial)
        x = torch::replication_pad2d(x, { 1, 1, 1, 1 });
    for (std::size_t l = 0; l < weight.size(); ++l) {
        torch::Tensor w = weight[l], b = bias[l];
        if (const std::int64_t missing = kFewestOutputs - w.size(1); missing > 0) {
            w = torch::constant_pad_nd(w, { 0, 0, 0, 0, 0, 0, 0, missing });
            b = torch::constant_pad_nd(b, { 0, missing });
        }
        x = spatial ? convolve_3x3(x, w, b) : convolve_1x1(x, w, b);
        if (l + 1 < weight.size())
            x = spatial ? relu_with_border(x) : torch::relu(x);
    }
    return (image + x.view({ images, -1, height, width }).narrow(1, 0, 3)).clamp(0, 1);
}

torch::Tensor perceptual(const torch::Tensor& linear)
{
    return torch::exp(torch::log(linear.clamp_min(kPerceptualFloor)) * (1 / 2.2)) - 0.3;
}

torch::Tensor reverse_pipeline(const torch::Tensor& source, const ChosenParameters& choice)
{
    torch::Tensor v = source;
    if (!choice.tone_reverse_weight.empty())
        v = apply_tone_map(v, choice.tone_reverse_weight, choice.tone_reverse_bias);
    v = power(v, choice.gamma);
    v = color_transform(v, inverse3x3(choice.color));
    v = inverse_gain(v, choice.white_balance);
    return inverse_gain(v, choice.gain.unsqueeze(1)).clamp(0, 1);
}

torch::Tensor forward_pipeline(const torch::Tensor& raw, const ChosenParameters& choice, bool white_stays_white)
{
    const torch::Tensor gain = choice.gain.view({ -1, 1, 1, 1 }), balance = choice.white_balance.view({ -1, 3, 1, 1 });
    torch::Tensor v = ((raw * gain).clamp(0, 1) * balance).clamp(0, 1);
    if (white_stays_white)
        v = torch::where(gain < 1, rebuilt_highlights(raw * balance, gain), v);
    v = color_transform(v, choice.color);
    v = power(v, choice.gamma.reciprocal());
    if (!choice.tone_forward_weight.empty())
        v = apply_tone_map(v, choice.tone_forward_weight, choice.tone_forward_bias);
    return v;
}

} // namespace srisp::train
