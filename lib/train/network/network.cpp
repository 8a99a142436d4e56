// SPDX-License-Identifier: Apache-2.0
#include "train/network/network.h"

#include "train/network/anchor_network.h"
#include "train/network/pipeline.h"

namespace srisp::train {

namespace {

constexpr int kToneLayers = 4, kFeatures = 128, kStatistics = 12;

Selection selection_kind(const ModelSettings& settings, const std::string& block)
{
    if (settings.selection == "static" || block == "static")
        return Selection::fixed;
    return settings.selection == "dynamic" ? Selection::dynamic : Selection::intermediate;
}

/// Σ_k w_k atom_k: weights [N, K], atoms [K, …], result [N, …].
torch::Tensor mixed(const torch::Tensor& weights, const torch::Tensor& atoms)
{
    std::vector<std::int64_t> shape = atoms.sizes().vec();
    shape[0] = weights.size(0);
    return torch::matmul(weights, atoms.reshape({ atoms.size(0), -1 })).view(shape);
}

/// Gain match: the RAW's channel means are the reference's, ln mean = 2 s − 2 [method 2].
torch::Tensor gain_match_anchor()
{
    return torch::cat({ torch::zeros({ 3, kStatistics }), 2 * torch::eye(3, kStatistics) }, 1);
}

} // namespace

Network::Network(const ModelSettings& settings, std::uint64_t seed)
    : m_settings(settings.resolved()), m_perceptual(m_settings.encoder_input == "perceptual")
{
    InitialWeights initial(seed);
    const int atoms = m_settings.dictionary_size;
    const auto layer = [&](const char* name, std::int64_t outputs, std::int64_t inputs) {
        return register_module(name, std::make_shared<Layer>(initial.affine({ outputs, inputs })));
    };
    const auto selector = [&](const char* name, const std::string& kind, int channels, int dictionaries) {
        return register_module(name, std::make_shared<BlockSelector>(selection_kind(m_settings, kind), channels,
                                                                     dictionaries, atoms, initial));
    };
    if (m_settings.selection == "dynamic") {
        const std::vector<std::int64_t> channels{ 3, 32, 64, kFeatures, kFeatures, kFeatures };
        m_source_encoder = register_module("source_encoder", std::make_shared<FeatureEncoder>(channels, initial));
        m_reference_encoder = register_module("reference_encoder", std::make_shared<FeatureEncoder>(channels, initial));
        if (m_settings.statistics) {
            m_source_statistics = layer("source_statistics", kFeatures, kStatistics);
            m_reference_statistics = layer("reference_statistics", kFeatures, kStatistics);
        }
        m_fuse = layer("fuse", kFeatures, 2 * kFeatures);
    }
    if (m_settings.anchor)
        m_anchor = layer("anchor", 3, kAnchorStatistics);
    if (m_settings.anchor && m_settings.anchor_network) {
        m_anchor_network = register_module("anchor_network", std::make_shared<AnchorNetwork>(initial));
        m_anchor_deviation = register_module("anchor_deviation", std::make_shared<AnchorDeviation>(initial));
    }
    m_tone = selector("tone", m_settings.tone, 3, kToneLayers);
    m_gamma = selector("gamma", m_settings.gamma, 3 * atoms, 1);
    m_color = selector("color", "dynamic", 3 * atoms, 1);
    m_white_balance = selector("white_balance", "dynamic", 3 * atoms, 1);
    if (m_settings.gain == "separate")
        m_gain = selector("gain", "dynamic", 3 * atoms, 1);
    m_dictionaries = register_module("dictionary", std::make_shared<Dictionaries>(m_settings, initial));
    if (m_anchor)
        set_anchor(gain_match_anchor(), torch::full({ 3 }, -2));
}

void Network::set_anchor(const torch::Tensor& weight, const torch::Tensor& bias)
{
    const torch::NoGradGuard no_gradient;
    m_anchor->weight.copy_(weight);
    m_anchor->bias.copy_(bias);
}

/// Chooses block after block on the running image.
class SelectionRun {
public:
    SelectionRun(const Network& network, const torch::Tensor& source, const torch::Tensor& reference,
                 ChosenParameters& choice, Trace* trace)
        : m_network(network), m_atoms(*network.m_dictionaries), m_images(source.size(0)), m_source(source),
          m_reference(reference), m_running(source), m_choice(choice), m_trace(trace)
    {
    }

    torch::Tensor run()
    {
        encode_images();
        choose_tone();
        choose_gamma();
        choose_color();
        find_base();
        choose_white_balance();
        choose_gain();
        return m_running;
    }

private:
    void note(const char* name, const torch::Tensor& value)
    {
        if (m_trace)
            (*m_trace)[name] = value;
    }

    torch::Tensor display_input(const torch::Tensor& image) const
    {
        return m_network.m_perceptual ? image - 0.4 : image;
    }
    torch::Tensor linear_input(const torch::Tensor& image) const
    {
        return m_network.m_perceptual ? perceptual(image) : image;
    }

    void encode_images()
    {
        if (m_network.m_source_statistics || m_network.m_anchor) {
            m_linear_source = linear_source(m_source);
            m_source_statistics = image_statistics(m_linear_source);
            m_reference_statistics = image_statistics(m_reference);
            note("source_statistics", m_source_statistics);
            note("reference_statistics", m_reference_statistics);
        }
        if (!m_network.m_source_encoder)
            return;
        torch::Tensor source = m_network.m_source_encoder->forward(display_input(m_source));
        torch::Tensor reference = m_network.m_reference_encoder->forward(linear_input(m_reference));
        if (m_network.m_source_statistics) {
            source = source + m_network.m_source_statistics->affine(m_source_statistics);
            reference = reference + m_network.m_reference_statistics->affine(m_reference_statistics);
        }
        m_fused = m_network.m_fuse->affine(torch::cat({ source, reference }, 1));
        note("source_features", source);
        note("reference_features", reference);
        note("fused_features", m_fused);
    }

    /// Weights of a block's one dictionary; `candidates` gives the reverse outputs of its atoms, [N, K, 3, H, W].
    template<class Candidates>
    torch::Tensor choose(const char* name, const BlockSelector& block, const Candidates& candidates)
    {
        const auto input = [&] { return linear_input(candidates()).flatten(1, 2); };
        return m_choice.weights[name] = block.weights(m_images, m_fused, input).front();
    }

    void choose_tone()
    {
        const std::vector<torch::Tensor> weights =
            m_network.m_tone->weights(m_images, m_fused, [&] { return display_input(m_source); });
        for (std::size_t l = 0; l < weights.size(); ++l) {
            m_choice.weights["tone." + std::to_string(l)] = weights[l];
            m_choice.tone_reverse_weight.push_back(mixed(weights[l], m_atoms.tone_reverse[l]->weight));
            m_choice.tone_reverse_bias.push_back(mixed(weights[l], m_atoms.tone_reverse[l]->bias));
            m_choice.tone_forward_weight.push_back(mixed(weights[l], m_atoms.tone_forward[l]->weight));
            m_choice.tone_forward_bias.push_back(mixed(weights[l], m_atoms.tone_forward[l]->bias));
        }
        m_running = apply_tone_map(m_running, m_choice.tone_reverse_weight, m_choice.tone_reverse_bias);
        note("after_tone", m_running);
    }

    void choose_gamma()
    {
        const torch::Tensor weights =
            choose("gamma", *m_network.m_gamma, [&] { return power_candidates(m_running, m_atoms.gamma); });
        m_choice.gamma = mixed(weights, m_atoms.gamma);
        m_running = power(m_running, m_choice.gamma);
        note("after_gamma", m_running);
    }

    void choose_color()
    {
        const torch::Tensor matrices = m_atoms.normalized_color();
        const torch::Tensor weights =
            choose("color", *m_network.m_color, [&] { return color_candidates(m_running, inverse3x3(matrices)); });
        m_choice.color = mixed(weights, matrices);
        m_running = color_transform(m_running, inverse3x3(m_choice.color));
        note("after_color", m_running);
    }

    /// The means of the RAW that the anchor expects, and how sure it is. It learns in its fit alone: a batch says too
    /// little about brightness.
    void expect_means()
    {
        const torch::NoGradGuard no_gradient;
        const torch::Tensor statistics = torch::cat({ m_source_statistics, m_reference_statistics }, 1);
        m_choice.expected_means = m_network.m_anchor->affine(statistics);
        if (!m_network.m_anchor_network)
            return;
        const torch::Tensor inputs = anchor_inputs(statistics, m_linear_source, m_reference);
        m_choice.expected_means = m_choice.expected_means + m_network.m_anchor_network->forward(inputs);
        m_choice.log_deviation = m_network.m_anchor_deviation->forward(m_network.m_anchor_network->hidden(inputs));
    }

    /// b_c = mean of the running image / predicted mean of the RAW [method 2, anchor]
    void find_base()
    {
        m_choice.base = torch::ones({ m_images, 3 }, m_source.options());
        if (m_network.m_anchor) {
            expect_means();
            m_choice.base = m_running.mean({ 2, 3 }).clamp_min(1e-3) / torch::exp(m_choice.expected_means);
        }
        note("base_gain", m_choice.base);
    }

    void choose_white_balance()
    {
        // Merged with the gain, the dictionary carries all of the base.
        const torch::Tensor green = m_choice.base.slice(1, 1, 2);
        const torch::Tensor base = m_network.m_gain ? m_choice.base / green : m_choice.base;
        const torch::Tensor gains = m_atoms.channel_gains();
        const auto scaled = [&](const torch::Tensor& products) {
            return m_network.m_settings.white_stays_white ? products / products.amin(-1, true) : products;
        };
        const torch::Tensor weights = choose("white_balance", *m_network.m_white_balance, [&] {
            return inverse_gain_candidates(m_running, scaled(gains.unsqueeze(0) * base.unsqueeze(1)));
        });
        m_choice.white_balance = scaled(mixed(weights, gains) * base);
        m_running = inverse_gain(m_running, m_choice.white_balance);
        note("after_white_balance", m_running);
    }

    void choose_gain()
    {
        if (!m_network.m_gain) {
            m_choice.gain = torch::ones({ m_images }, m_source.options());
            m_running = m_running.clamp(0, 1);
            return;
        }
        const torch::Tensor base = m_choice.base.select(1, 1) / m_choice.white_balance.select(1, 1);
        const torch::Tensor weights = choose("gain", *m_network.m_gain, [&] {
            return inverse_gain_candidates(m_running, (m_atoms.gain.unsqueeze(0) * base.unsqueeze(1)).unsqueeze(2));
        });
        m_choice.gain = mixed(weights, m_atoms.gain) * base;
        m_running = inverse_gain(m_running, m_choice.gain.unsqueeze(1)).clamp(0, 1);
        note("after_gain", m_running);
    }

    const Network& m_network;
    const Dictionaries& m_atoms;
    const std::int64_t m_images;
    const torch::Tensor m_source, m_reference;
    torch::Tensor m_running, m_linear_source, m_source_statistics, m_reference_statistics, m_fused;
    ChosenParameters& m_choice;
    Trace* m_trace;
};

torch::Tensor Network::traced_reverse(const torch::Tensor& source, const torch::Tensor& reference,
                                      ChosenParameters& choice, Trace* trace)
{
    choice = {};
    return SelectionRun(*this, source, reference, choice, trace).run();
}

torch::Tensor Network::reverse(const torch::Tensor& source, const torch::Tensor& reference, ChosenParameters* choice)
{
    ChosenParameters own;
    return traced_reverse(source, reference, choice ? *choice : own, nullptr);
}

torch::Tensor Network::apply_reverse(const torch::Tensor& image, const ChosenParameters& choice)
{
    return reverse_pipeline(image, choice);
}

torch::Tensor Network::process(const torch::Tensor& raw, const ChosenParameters& choice)
{
    return forward_pipeline(raw, choice, m_settings.white_stays_white);
}

std::vector<torch::Tensor> Network::dictionary_parameters()
{
    std::vector<torch::Tensor> all = m_dictionaries->scalars();
    for (const BlockSelector* block :
         { m_tone.get(), m_gamma.get(), m_color.get(), m_white_balance.get(), m_gain.get() })
        if (block)
            for (const torch::Tensor& parameter : block->fixed_parameters())
                all.push_back(parameter);
    return all;
}

std::vector<torch::Tensor> Network::anchor_parameters()
{
    std::vector<torch::Tensor> all;
    if (m_anchor)
        all = m_anchor->parameters();
    if (m_anchor_network)
        for (const torch::nn::Module* module : { static_cast<torch::nn::Module*>(m_anchor_network.get()),
                                                 static_cast<torch::nn::Module*>(m_anchor_deviation.get()) })
            for (const torch::Tensor& parameter : module->parameters())
                all.push_back(parameter);
    return all;
}

void Network::constrain()
{
    m_dictionaries->constrain();
}

} // namespace srisp::train
