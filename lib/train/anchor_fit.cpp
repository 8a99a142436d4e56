// SPDX-License-Identifier: Apache-2.0
#include "anchor_fit.h"

#include <algorithm>

#include "image_statistics.h"
#include "network.h"

namespace srisp::train {

namespace {

constexpr int kBatch = 64, kStatistics = 12;

double root_mean_square(const torch::Tensor& errors)
{
    return errors.square().mean().sqrt().item<double>();
}

} // namespace

AnchorFit fit_anchor(const torch::Tensor& statistics, const torch::Tensor& truth_means, double ridge)
{
    const torch::Tensor s = statistics.to(torch::kFloat64);
    const torch::Tensor log_means = truth_means.to(torch::kFloat64).clamp_min(1e-3).log();
    // The bias takes no penalty: centred values leave it out of the equations.
    const torch::Tensor s_mean = s.mean(0), log_mean = log_means.mean(0);
    const torch::Tensor centred = s - s_mean;
    const torch::Tensor normal =
        torch::mm(centred.t(), centred) + ridge * static_cast<double>(s.size(0)) * torch::eye(s.size(1), s.options());
    const torch::Tensor weight = torch::linalg_solve(normal, torch::mm(centred.t(), log_means - log_mean)).t();

    AnchorFit fit;
    const torch::Tensor bias = log_mean - torch::mv(weight, s_mean);
    fit.deviation = root_mean_square(torch::addmm(bias, s, weight.t()) - log_means);
    fit.gain_match_deviation = root_mean_square(2 * s.slice(1, kStatistics, kStatistics + 3) - 2 - log_means);
    fit.weight = weight.to(torch::kFloat32);
    fit.bias = bias.to(torch::kFloat32);
    return fit;
}

std::optional<AnchorFit> start_anchor(Unprocessor& model, Samples& samples, const AnchorFitSettings& settings)
{
    auto* const network = dynamic_cast<Network*>(&model);
    if (!network || !network->has_anchor())
        return {};
    const torch::NoGradGuard no_gradient;
    std::vector<torch::Tensor> statistics, means;
    for (int done = 0, step = 0; done < settings.pairs; ++step) {
        const int count = std::min(kBatch, settings.pairs - done);
        const Batch batch = samples.batch(step, 0, count, 0, 0);
        statistics.push_back(torch::cat({ source_statistics(batch.source), image_statistics(batch.reference) }, 1));
        means.push_back(batch.truth.mean({ 2, 3 }));
        done += count;
    }
    const AnchorFit fit = fit_anchor(torch::cat(statistics).cpu(), torch::cat(means).cpu(), settings.ridge);
    network->set_anchor(fit.weight, fit.bias);
    return fit;
}

} // namespace srisp::train
