// SPDX-License-Identifier: Apache-2.0
#include "select/selection.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "apply/tone_map.h"
#include "features/image_features.h"
#include "features/match_features.h"
#include "select/layers.h"
#include "select/trained_range.h"

namespace srisp {

namespace {

constexpr std::size_t kCount = PlanarThumbnail::kCount;

PlanarThumbnail planar(const Thumbnail& thumbnail)
{
    PlanarThumbnail result;
    for (std::size_t i = 0; i < kCount; ++i)
        for (int c = 0; c < 3; ++c)
            result.planes().plane(c)[i] = thumbnail.rgb[i * 3 + c];
    return result;
}

enum class Scale { display, linear };

/// Three planes as encoder input [method 2]: brought to a like scale, unless the model wants them plain.
void add_to_input(StridedInput& input, int first_channel, Planes image, Scale scale, bool perceptual)
{
    PlanarThumbnail scaled;
    if (perceptual && scale == Scale::linear) {
        power(image, scaled.planes(), kCount, 1 / 2.2f, 1e-5f, -0.3f);
        image = scaled.planes();
    }
    std::vector<float> row(kThumbnailSize);
    const float offset = perceptual && scale == Scale::display ? 0.4f : 0.0f;
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < kThumbnailSize; ++y) {
            const float* values = image.plane(c) + y * kThumbnailSize;
            std::transform(values, values + kThumbnailSize, row.begin(), [&](float v) { return v - offset; });
            input.set_row(first_channel + c, y, row.data());
        }
}

/// Chooses block after block on the running thumbnail.
class Selection {
public:
    Selection(const ModelData& model, const Thumbnail& source, const Thumbnail& reference,
              std::vector<std::string>* notes, SelectionTrace* trace)
        : m_model(model), m_running(planar(source)), m_reference(planar(reference)), m_notes(notes), m_trace(trace)
    {
    }

    Parameters run()
    {
        encode_images();
        choose_tone();
        choose_gamma();
        choose_color();
        anchor();
        choose_white_balance();
        choose_gain();
        return m_parameters;
    }

private:
    using Candidate = std::function<void(int atom, Planes out)>;

    void note(PlanarThumbnail SelectionTrace::*step)
    {
        if (m_trace)
            m_trace->*step = m_running;
    }

    std::vector<float> image_features(const EncoderWeights& encoder, Planes image, Scale scale) const
    {
        StridedInput input(3, kThumbnailSize);
        add_to_input(input, 0, image, scale, m_model.perceptual_encoder_input);
        return encode(encoder, std::move(input));
    }

    void add_statistics(std::vector<float>& features, const DenseLayer& layer,
                        const std::array<float, 12>& numbers) const
    {
        const std::vector<float> extra = transformed(layer, { numbers.begin(), numbers.end() });
        std::transform(features.begin(), features.end(), extra.begin(), features.begin(), std::plus<float>());
    }

    void encode_images()
    {
        std::vector<float> source = image_features(m_model.source_encoder, m_running.planes(), Scale::display);
        std::vector<float> reference = image_features(m_model.reference_encoder, m_reference.planes(), Scale::linear);
        if (m_model.source_statistics) {
            PlanarThumbnail linear;
            power(m_running.planes(), linear.planes(), kCount, 2.2f, 1e-8f, 0);
            m_source_statistics = statistics(linear.planes(), kCount);
            m_reference_statistics = statistics(m_reference.planes(), kCount);
            if (!m_model.anchor_network.empty()) {
                const ReducedImage small_source = reduced({ linear.planes(), kThumbnailSize, kThumbnailSize });
                const ReducedImage small_reference = reduced({ m_reference.planes(), kThumbnailSize, kThumbnailSize });
                m_source_quantiles = quantile_features(small_source);
                m_reference_quantiles = quantile_features(small_reference);
                m_match = match_features(small_source, small_reference);
            }
            add_statistics(source, *m_model.source_statistics, m_source_statistics);
            add_statistics(reference, *m_model.reference_statistics, m_reference_statistics);
        }
        m_fused = transformed(m_model.fuse, concatenated(source, reference));
        if (m_trace) {
            m_trace->source_statistics = m_source_statistics;
            m_trace->reference_statistics = m_reference_statistics;
            m_trace->source_features = source;
            m_trace->reference_features = reference;
            m_trace->fused_features = m_fused;
        }
    }

    /// softmax(H · (P · g_xr + g_i))
    std::vector<float> weights(const BlockSelector& block, int dictionary, const std::vector<float>& features) const
    {
        std::vector<float> sum = transformed(block.project[dictionary], m_fused);
        std::transform(sum.begin(), sum.end(), features.begin(), sum.begin(), std::plus<float>());
        return softmax(transformed(block.head[dictionary], sum));
    }

    /// Weights of a block whose features come from the reverse outputs of each of its atoms.
    std::vector<float> candidate_weights(const BlockSelector& block, const Candidate& candidate)
    {
        StridedInput input(3 * m_model.dictionary_size, kThumbnailSize);
        PlanarThumbnail out;
        for (int atom = 0; atom < m_model.dictionary_size; ++atom) {
            candidate(atom, out.planes());
            add_to_input(input, 3 * atom, out.planes(), Scale::linear, m_model.perceptual_encoder_input);
        }
        return weights(block, 0, encode(block.encoder, std::move(input)));
    }

    void choose_tone()
    {
        const std::vector<float> features = image_features(m_model.tone.encoder, m_running.planes(), Scale::display);
        for (int l = 0; l < kToneLayers; ++l)
            m_parameters.tone_weights[l] = weights(m_model.tone, l, features);
        apply_tone_map();
        note(&SelectionTrace::after_tone);
    }

    void apply_tone_map()
    {
        const auto tone_map = mix_tone_map(m_model.tone_reverse, m_parameters.tone_weights, ToneMethod::winograd);
        const auto runner = tone_map->make_runner();
        PlanarThumbnail result;
        const Planes in = m_running.planes(), out = result.planes();
        for (int x0 = 0; x0 < kThumbnailSize; x0 += tone_map->max_tile_width()) {
            const int x1 = std::min(x0 + tone_map->max_tile_width(), kThumbnailSize);
            const auto load = [&](int y, int begin, int end, Planes row) {
                for (int c = 0; c < 3; ++c)
                    std::copy_n(in.plane(c) + y * kThumbnailSize + begin, end - begin, row.plane(c));
            };
            const auto store = [&](int y, Planes row) {
                for (int c = 0; c < 3; ++c)
                    std::copy_n(row.plane(c), x1 - x0, out.plane(c) + y * kThumbnailSize + x0);
            };
            runner->run({ x0, x1, 0, kThumbnailSize }, kThumbnailSize, kThumbnailSize, load, store);
        }
        m_running = std::move(result);
    }

    void choose_gamma()
    {
        const auto apply = [&](float gamma, Planes out) { power(m_running.planes(), out, kCount, gamma, 1e-8f, 0); };
        m_parameters.gamma_weights =
            candidate_weights(m_model.gamma, [&](int atom, Planes out) { apply(m_model.gamma_atoms[atom], out); });
        m_parameters.gamma = 0;
        for (int k = 0; k < m_model.dictionary_size; ++k)
            m_parameters.gamma += m_parameters.gamma_weights[k] * m_model.gamma_atoms[k];
        apply(m_parameters.gamma, m_running.planes());
        note(&SelectionTrace::after_gamma);
    }

    void choose_color()
    {
        const auto apply = [&](const Matrix3& color, Planes out) {
            color_transform(m_running.planes(), out, kCount, inverse(color));
        };
        m_parameters.color_weights =
            candidate_weights(m_model.color, [&](int atom, Planes out) { apply(m_model.color_atoms[atom], out); });
        m_parameters.color.fill(0);
        for (int k = 0; k < m_model.dictionary_size; ++k)
            for (int i = 0; i < 9; ++i)
                m_parameters.color[i] += m_parameters.color_weights[k] * m_model.color_atoms[k][i];
        apply(m_parameters.color, m_running.planes());
        note(&SelectionTrace::after_color);
    }

    /// The means of the RAW that the anchor expects: a line, which a network corrects.
    std::vector<float> log_means() const
    {
        const auto append = [](std::vector<float>& numbers, const auto& more) {
            numbers.insert(numbers.end(), more.begin(), more.end());
        };
        std::vector<float> numbers;
        append(numbers, m_source_statistics);
        append(numbers, m_reference_statistics);
        std::vector<float> line = transformed(*m_model.anchor, numbers);
        if (m_model.anchor_network.empty())
            return line;
        append(numbers, m_source_quantiles);
        append(numbers, m_reference_quantiles);
        append(numbers, m_match);
        for (const DenseLayer& layer : m_model.anchor_network) {
            numbers = transformed(layer, numbers);
            if (&layer != &m_model.anchor_network.back())
                for (float& v : numbers)
                    v = std::max(v, 0.0f);
        }
        std::transform(line.begin(), line.end(), numbers.begin(), line.begin(), std::plus<float>());
        return line;
    }

    /// b_c = mean of the running thumbnail / predicted mean of the RAW [method 2, anchor]
    void anchor()
    {
        if (!m_model.anchor)
            return;
        const std::vector<float> log_means = this->log_means();
        for (int c = 0; c < 3; ++c) {
            const float* values = m_running.planes().plane(c);
            double sum = 0;
            for (std::size_t i = 0; i < kCount; ++i)
                sum += values[i];
            m_base_gain[c] = static_cast<float>(std::max(sum / kCount, 1e-3) / std::exp(double(log_means[c])));
        }
        if (m_trace)
            m_trace->base_gain = m_base_gain;
    }

    void choose_white_balance()
    {
        const float red = m_base_gain[0] / m_base_gain[1], blue = m_base_gain[2] / m_base_gain[1];
        const auto apply = [&](const std::array<float, 3>& gains, Planes out) {
            const float scales[] = { 1 / gains[0], 1 / gains[1], 1 / gains[2] };
            inverse_gain(m_running.planes(), out, kCount, scales);
        };
        const auto product = [&](const std::array<float, 2>& atom) {
            const float r = atom[0] * red, b = atom[1] * blue;
            const float one = m_model.white_stays_white ? std::min({ r, 1.0f, b }) : 1.0f;
            return std::array<float, 3>{ r / one, 1 / one, b / one };
        };
        m_parameters.white_balance_weights = candidate_weights(m_model.white_balance, [&](int atom, Planes out) {
            apply(product(m_model.white_balance_atoms[atom]), out);
        });
        std::array<float, 2> mixed{};
        for (int k = 0; k < m_model.dictionary_size; ++k)
            for (int i = 0; i < 2; ++i)
                mixed[i] += m_parameters.white_balance_weights[k] * m_model.white_balance_atoms[k][i];
        m_parameters.white_balance = product(mixed);
        keep_in_trained_range(m_parameters.white_balance, m_notes);
        apply(m_parameters.white_balance, m_running.planes());
        note(&SelectionTrace::after_white_balance);
    }

    void choose_gain()
    {
        const float base = m_base_gain[1] / m_parameters.white_balance[1];
        const auto apply = [&](float gain, Planes out) {
            const float scales[] = { 1 / gain, 1 / gain, 1 / gain };
            inverse_gain(m_running.planes(), out, kCount, scales);
        };
        m_parameters.gain_weights =
            candidate_weights(m_model.gain, [&](int atom, Planes out) { apply(m_model.gain_atoms[atom] * base, out); });
        float mixed = 0;
        for (int k = 0; k < m_model.dictionary_size; ++k)
            mixed += m_parameters.gain_weights[k] * m_model.gain_atoms[k];
        m_parameters.gain = mixed * base;
        keep_in_trained_range(m_parameters.gain, m_notes);
        if (!m_trace)
            return;
        apply(m_parameters.gain, m_running.planes());
        clamp01(m_running.planes(), m_running.planes(), kCount);
        note(&SelectionTrace::after_gain);
    }

    const ModelData& m_model;
    PlanarThumbnail m_running, m_reference;
    std::vector<std::string>* m_notes;
    SelectionTrace* m_trace;
    std::array<float, 12> m_source_statistics{}, m_reference_statistics{};
    std::array<float, kQuantileFeatures> m_source_quantiles{}, m_reference_quantiles{};
    std::array<float, kMatchFeatures> m_match{};
    std::vector<float> m_fused;
    std::array<float, 3> m_base_gain{ 1, 1, 1 };
    Parameters m_parameters;
};

} // namespace

Parameters select_parameters(const ModelData& model, const Thumbnail& source, const Thumbnail& reference,
                             std::vector<std::string>* notes, SelectionTrace* trace)
{
    return Selection(model, source, reference, notes, trace).run();
}

} // namespace srisp
