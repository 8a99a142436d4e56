// SPDX-License-Identifier: Apache-2.0
#include "train/anchor/anchor_fit.h"

#include <algorithm>

#include "train/learning/losses.h"
#include "train/learning/optimizer.h"
#include "train/network/anchor_network.h"
#include "train/network/network.h"

namespace srisp::train {

namespace {

constexpr int kBatch = 64; // one step's

constexpr int kStatistics = 12;
constexpr double kSmallest = 1e-3; // deviation of an input: some are the same in all images

/// Some of the pairs.
struct Rows {
    torch::Tensor inputs, means; ///< as in AnchorPairs
    torch::Tensor log_means() const { return means.select(1, 0); }
};

double root_mean_square(const torch::Tensor& errors)
{
    return errors.square().mean().sqrt().item<double>();
}

torch::Tensor line_of(const AnchorFit& fit, const torch::Tensor& inputs)
{
    return torch::addmm(fit.bias, inputs.slice(1, 0, kAnchorStatistics), fit.weight.t());
}

/// Adam on what the line misses.
void fit_network(AnchorNetwork& network, const Rows& rows, const AnchorFit& line, const AnchorFitSettings& settings,
                 std::uint64_t seed, const std::function<void(double)>& progress)
{
    ParameterVector parameters(network);
    const torch::Device device = parameters.values().device();
    const torch::Tensor mean = rows.inputs.mean(0).to(device);
    const torch::Tensor deviation = rows.inputs.std(0).clamp_min(kSmallest).to(device);
    const torch::Tensor inputs = (rows.inputs.to(device) - mean) / deviation;
    const torch::Tensor missed = (rows.log_means() - line_of(line, rows.inputs)).to(device);
    const torch::Tensor means = rows.means.to(device);

    if (settings.carry_on)
        network.take_scaled_inputs(mean, deviation);
    OptimizerSettings optimizer;
    optimizer.rate = settings.rate;
    optimizer.weight_decay = settings.weight_decay;
    const torch::Tensor none = torch::zeros_like(parameters.values());
    Adam adam(optimizer, parameters, none, parameters.mask_of(weights_of(network)));

    at::Generator generator = at::detail::createCPUGenerator(seed);
    const double kept = 1 - settings.dropout;
    const auto dropped = [&](const torch::Tensor& values) {
        return values * torch::empty(values.sizes()).bernoulli_(kept, generator).div_(kept).to(device);
    };
    for (int step = 0; step < settings.steps; ++step) {
        const torch::Tensor chosen =
            torch::randint(inputs.size(0), { settings.batch }, generator, torch::kLong).to(device);
        parameters.gradients().zero_();
        const torch::Tensor correction = network.forward(inputs.index_select(0, chosen), dropped);
        cost_of_means(correction - missed.index_select(0, chosen), means.index_select(0, chosen)).mean().backward();
        adam.update(step, rate_factor(optimizer, step, settings.steps), adam.gradient_norm());
        if (progress)
            progress(static_cast<double>(step + 1) / settings.steps);
    }
    network.take_plain_inputs(mean, deviation);
}

/// Learns how large the error of brightness is from pairs that the network did not learn from: on its own it is too
/// sure. Maximum likelihood of a normal distribution.
void fit_deviation(AnchorDeviation& deviation, const torch::Tensor& hidden, const torch::Tensor& errors,
                   std::uint64_t seed)
{
    constexpr int kSteps = 1500, kBatchOfErrors = 512;
    ParameterVector parameters(deviation);
    OptimizerSettings optimizer;
    optimizer.rate = 1e-3;
    optimizer.weight_decay = 0.1;
    const torch::Tensor none = torch::zeros_like(parameters.values());
    Adam adam(optimizer, parameters, none, parameters.mask_of(weights_of(deviation)));
    at::Generator generator = at::detail::createCPUGenerator(seed);
    const torch::Tensor squares = errors.square();
    for (int step = 0; step < kSteps; ++step) {
        const torch::Tensor chosen =
            torch::randint(hidden.size(0), { kBatchOfErrors }, generator, torch::kLong).to(hidden.device());
        parameters.gradients().zero_();
        const torch::Tensor s = deviation.forward(hidden.index_select(0, chosen));
        (s + 0.5 * squares.index_select(0, chosen) * torch::exp(-2 * s)).mean().backward();
        adam.update(step, rate_factor(optimizer, step, kSteps), adam.gradient_norm());
    }
}

} // namespace

AnchorPairs::AnchorPairs(int wanted, bool for_network)
    : m_inputs(torch::empty({ wanted, for_network ? kAnchorInputs : kAnchorStatistics })),
      m_means(torch::empty({ wanted, 3, 3 }))
{
}

void AnchorPairs::make_more(Samples& samples)
{
    const torch::NoGradGuard no_gradient;
    const int count = std::min(kBatch, wanted() - m_made);
    const Batch batch = samples.batch(m_made / kBatch, 0, count, 0, 0);
    const torch::Tensor source = linear_source(batch.source);
    const torch::Tensor statistics = torch::cat({ image_statistics(source), image_statistics(batch.reference) }, 1);
    const bool for_network = m_inputs.size(1) == kAnchorInputs;
    m_inputs.slice(0, m_made, m_made + count)
        .copy_(for_network ? anchor_inputs(statistics, source, batch.reference) : statistics);
    m_means.slice(0, m_made, m_made + count).copy_(means_of(batch.truth));
    m_made += count;
}

bool AnchorPairs::take(const torch::Tensor& inputs, const torch::Tensor& means)
{
    const std::int64_t count = inputs.size(0);
    const bool whole_steps = count % kBatch == 0 || count == wanted();
    if (count > wanted() || !whole_steps || inputs.sizes() != m_inputs.slice(0, 0, count).sizes() ||
        means.sizes() != m_means.slice(0, 0, count).sizes())
        return false;
    m_inputs.slice(0, 0, count).copy_(inputs);
    m_means.slice(0, 0, count).copy_(means);
    m_made = static_cast<int>(count);
    return true;
}

AnchorFit fit_line(const torch::Tensor& statistics, const torch::Tensor& log_means, double ridge)
{
    const torch::Tensor s = statistics.to(torch::kFloat64), l = log_means.to(torch::kFloat64);
    // The bias takes no penalty: centred values leave it out of the equations.
    const torch::Tensor s_mean = s.mean(0), l_mean = l.mean(0);
    const torch::Tensor centred = s - s_mean;
    const torch::Tensor normal =
        torch::mm(centred.t(), centred) + ridge * static_cast<double>(s.size(0)) * torch::eye(s.size(1), s.options());
    const torch::Tensor weight = torch::linalg_solve(normal, torch::mm(centred.t(), l - l_mean)).t();

    AnchorFit fit;
    fit.weight = weight.to(torch::kFloat32);
    fit.bias = (l_mean - torch::mv(weight, s_mean)).to(torch::kFloat32);
    return fit;
}

Status take_anchor(Unprocessor& model, Unprocessor& other)
{
    const std::vector<torch::Tensor> to = model.anchor_parameters(), from = other.anchor_parameters();
    if (from.empty() || to.empty())
        return Error{ from.empty() ? "has no anchor" : "has an anchor, and the recipe's model has none" };
    const auto same_shape = [](const torch::Tensor& a, const torch::Tensor& b) { return a.sizes() == b.sizes(); };
    if (!std::equal(to.begin(), to.end(), from.begin(), from.end(), same_shape))
        return Error{ "has an anchor of another kind than the recipe's model" };
    const torch::NoGradGuard no_gradient;
    for (std::size_t i = 0; i < to.size(); ++i)
        torch::Tensor(to[i]).copy_(from[i]);
    return {};
}

std::optional<AnchorPairs> pairs_for_anchor(Unprocessor& model, const AnchorFitSettings& settings)
{
    auto* const network = dynamic_cast<Network*>(&model);
    if (!network || !network->has_anchor() || (settings.carry_on && !network->anchor_network()))
        return {};
    return AnchorPairs(settings.pairs, network->anchor_network() != nullptr);
}

void mix_anchors(Unprocessor& model, Unprocessor& first, Unprocessor& second, double share)
{
    const std::vector<torch::Tensor> to = model.anchor_parameters(), a = first.anchor_parameters(),
                                     b = second.anchor_parameters();
    const torch::NoGradGuard no_gradient;
    for (std::size_t i = 0; i < to.size(); ++i)
        torch::Tensor(to[i]).copy_(torch::lerp(a[i], b[i], share));
}

namespace {

/// The last tenth of the pairs is left out of the fit.
std::int64_t fitted_of(const AnchorPairs& pairs)
{
    return pairs.made() - pairs.made() / 10;
}

Rows rows_of(const AnchorPairs& pairs, std::int64_t begin, std::int64_t end)
{
    return { pairs.inputs().slice(0, begin, end), pairs.means().slice(0, begin, end) };
}

AnchorFit own_line(Unprocessor& model)
{
    const std::vector<torch::Tensor> anchor = model.anchor_parameters();
    AnchorFit line;
    line.weight = anchor[0].detach().cpu();
    line.bias = anchor[1].detach().cpu();
    return line;
}

/// What the network corrects, less what it should.
torch::Tensor errors_of(AnchorNetwork& network, const torch::Tensor& line_errors, const torch::Tensor& inputs)
{
    const torch::NoGradGuard no_gradient;
    return line_errors.to(inputs.device()) + network.forward(inputs);
}

} // namespace

AnchorFit fit_anchor(Unprocessor& model, const AnchorPairs& pairs, const AnchorFitSettings& settings,
                     std::uint64_t seed, const std::function<void(double)>& progress)
{
    auto& network = dynamic_cast<Network&>(model);
    AnchorNetwork* const correction = network.anchor_network();
    const Rows rows = rows_of(pairs, 0, fitted_of(pairs)), tested = rows_of(pairs, fitted_of(pairs), pairs.made());
    AnchorFit fit;
    if (settings.carry_on) {
        fit = own_line(model);
    } else {
        fit = fit_line(rows.inputs.slice(1, 0, kAnchorStatistics), rows.log_means(), settings.ridge);
        network.set_anchor(fit.weight, fit.bias);
    }
    if (correction)
        fit_network(*correction, rows, fit, settings, seed, progress);

    torch::Tensor error = line_of(fit, tested.inputs) - tested.log_means();
    fit.line_deviation = root_mean_square(error);
    if (correction)
        error = errors_of(*correction, error, tested.inputs.to(model.parameters().front().device()));
    fit.deviation = root_mean_square(error);
    fit.gain_match_deviation =
        root_mean_square(2 * tested.inputs.slice(1, kStatistics, kStatistics + 3) - 2 - tested.log_means());
    return fit;
}

void fit_anchor_deviation(Unprocessor& model, const AnchorPairs& pairs, std::uint64_t seed)
{
    auto& network = dynamic_cast<Network&>(model);
    AnchorNetwork* const correction = network.anchor_network();
    if (!correction)
        return;
    const Rows tested = rows_of(pairs, fitted_of(pairs), pairs.made());
    const torch::Tensor inputs = tested.inputs.to(model.parameters().front().device());
    const torch::Tensor line_errors = line_of(own_line(model), tested.inputs) - tested.log_means();
    const torch::Tensor error = errors_of(*correction, line_errors, inputs);
    torch::Tensor hidden;
    {
        const torch::NoGradGuard no_gradient;
        hidden = correction->hidden(inputs);
    }
    fit_deviation(*network.anchor_deviation(), hidden, error.mean(1), seed);
}

} // namespace srisp::train
