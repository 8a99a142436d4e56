// SPDX-License-Identifier: Apache-2.0
#include "pipeline_blocks.h"

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

} // namespace

torch::Tensor power(const torch::Tensor& image, const torch::Tensor& exponent)
{
    return torch::exp(floored_log(image) * exponent.view({ -1, 1, 1, 1 }));
}

torch::Tensor power_candidates(const torch::Tensor& image, const torch::Tensor& gamma)
{
    return torch::exp(floored_log(image).unsqueeze(1) * gamma.view({ 1, -1, 1, 1, 1 }));
}

torch::Tensor inverse3x3(const torch::Tensor& matrix)
{
    const auto row = [&](int i) { return matrix.select(-2, i); };
    // Columns of the adjugate are cross products of the rows.
    const torch::Tensor first = torch::cross(row(1), row(2), -1);
    const torch::Tensor determinant = (row(0) * first).sum(-1, true).unsqueeze(-1);
    return torch::stack({ first, torch::cross(row(2), row(0), -1), torch::cross(row(0), row(1), -1) }, -1) /
           determinant;
}

torch::Tensor row_normalized(const torch::Tensor& matrix)
{
    return matrix / matrix.sum(-1, true);
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

torch::Tensor perceptual(const torch::Tensor& linear)
{
    return torch::exp(torch::log(linear.clamp_min(kPerceptualFloor)) * (1 / 2.2)) - 0.3;
}

} // namespace srisp::train
