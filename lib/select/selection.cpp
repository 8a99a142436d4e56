// SPDX-License-Identifier: Apache-2.0
#include "select/selection.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "apply/tone_map.h"
#include "features/match_features.h"
#include "features/sums.h"
#include "kernels/color_blocks.h"
#include "select/layers.h"
#include "select/trained_range.h"

namespace srisp {

namespace {

/// Chooses block after block on the running thumbnail.
class Selection {
public:
    Selection(const ModelData& model, const Thumbnail& source, const ReferenceFeatures& reference,
              std::vector<std::string>* notes, SelectionTrace* trace)
        : m_model(model), m_running(source, model.selection_size), m_reference(reference), m_notes(notes),
          m_trace(trace), m_scale(linear_scale(model.perceptual_encoder_input))
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
    /// Writes an atom's reverse output, with the encoder's exponent.
    using Candidate = std::function<void(int atom, Planes out)>;

    void note(PlanarThumbnail SelectionTrace::*step)
    {
        if (m_trace)
            m_trace->*step = m_running;
    }

    /// The photo, before the first block has changed it.
    EncoderInput photo_input() const { return display_input(m_running, m_model.perceptual_encoder_input); }

    void encode_images()
    {
        PlanarThumbnail linear_image(m_running.size());
        power(m_running.planes(), linear_image.planes(), m_running.count(), 2.2f, kPowerFloor);
        const LinearImage linear(linear_image);
        m_source = image_features(m_model, m_model.source_encoder, m_model.source_statistics, photo_input(), linear);
        if (m_reference.match)
            m_match = match_features(linear.small, *m_reference.match);
        m_fused = transformed(m_model.fuse, concatenated(m_source.encoded, m_reference.encoded));
        if (m_trace) {
            m_trace->source_statistics = m_source.colors.statistics;
            m_trace->reference_statistics = m_reference.colors.statistics;
            m_trace->source_features = m_source.encoded;
            m_trace->reference_features = m_reference.encoded;
            m_trace->fused_features = m_fused;
        }
    }

    /// softmax(H · (P · g_xr + g_i))
    std::vector<float> weights(const BlockSelector& block, int dictionary, const std::vector<float>& features) const
    {
        std::vector<float> sum = transformed(block.project[dictionary], m_fused);
        add(sum, features);
        return softmax(transformed(block.head[dictionary], sum));
    }

    /// Weights of a block whose features come from the reverse outputs of each of its atoms.
    std::vector<float> candidate_weights(const BlockSelector& block, const Candidate& candidate)
    {
        EncoderInput input(3 * m_model.dictionary_size, m_running.size());
        PlanarThumbnail out(m_running.size());
        for (int atom = 0; atom < m_model.dictionary_size; ++atom) {
            candidate(atom, out.planes());
            add_to_input(input, 3 * atom, out.planes(), m_scale.offset);
        }
        return weights(block, 0, encode(block.encoder, std::move(input)));
    }

    void choose_tone()
    {
        const std::vector<float> features = encode(m_model.tone.encoder, photo_input());
        for (int l = 0; l < kToneLayers; ++l)
            m_parameters.tone_weights[l] = weights(m_model.tone, l, features);
        apply_tone_map();
        note(&SelectionTrace::after_tone);
    }

    void apply_tone_map()
    {
        const auto tone_map = mix_tone_map(m_model.tone_reverse, m_parameters.tone_weights, ToneMethod::plain);
        const auto runner = tone_map->make_runner();
        const int size = m_running.size();
        PlanarThumbnail result(size);
        const Planes in = m_running.planes(), out = result.planes();
        for (int x0 = 0; x0 < size; x0 += tone_map->max_tile_width()) {
            const int x1 = std::min(x0 + tone_map->max_tile_width(), size);
            const auto load = [&](int y, int begin, int end, Planes row) {
                for (int c = 0; c < 3; ++c)
                    std::copy_n(in.plane(c) + y * size + begin, end - begin, row.plane(c));
            };
            const auto store = [&](int y, Planes row) {
                for (int c = 0; c < 3; ++c)
                    std::copy_n(row.plane(c), x1 - x0, out.plane(c) + y * size + x0);
            };
            runner->run({ x0, x1, 0, size }, size, size, load, store);
        }
        m_running = std::move(result);
    }

    void choose_gamma()
    {
        const Planes running = m_running.planes();
        m_parameters.gamma_weights = candidate_weights(m_model.gamma, [&](int atom, Planes out) {
            const float gamma = m_model.gamma_atoms[atom], darkest = std::pow(m_scale.floor, 1 / gamma);
            power(running, out, m_running.count(), gamma * m_scale.exponent, std::max(kPowerFloor, darkest));
        });
        m_parameters.gamma = 0;
        for (int k = 0; k < m_model.dictionary_size; ++k)
            m_parameters.gamma += m_parameters.gamma_weights[k] * m_model.gamma_atoms[k];
        power(running, running, m_running.count(), m_parameters.gamma, kPowerFloor);
        note(&SelectionTrace::after_gamma);
    }

    void choose_color()
    {
        const auto apply = [&](const Matrix3& color, Planes out) {
            color_transform(m_running.planes(), out, m_running.count(), inverse(color));
        };
        m_parameters.color_weights = candidate_weights(m_model.color, [&](int atom, Planes out) {
            apply(m_model.color_atoms[atom], out);
            power(out, out, m_running.count(), m_scale.exponent, m_scale.floor);
        });
        m_parameters.color.fill(0);
        for (int k = 0; k < m_model.dictionary_size; ++k)
            for (int i = 0; i < 9; ++i)
                m_parameters.color[i] += m_parameters.color_weights[k] * m_model.color_atoms[k][i];
        apply(m_parameters.color, m_running.planes());
        note(&SelectionTrace::after_color);
    }

    /// The means of the RAW that the anchor expects: a line, which a network corrects.
    std::vector<float> log_means()
    {
        const auto append = [](std::vector<float>& numbers, const auto& more) {
            numbers.insert(numbers.end(), more.begin(), more.end());
        };
        std::vector<float> numbers;
        append(numbers, m_source.colors.statistics);
        append(numbers, m_reference.colors.statistics);
        std::vector<float> line = transformed(*m_model.anchor, numbers);
        if (m_model.anchor_network.empty())
            return line;
        append(numbers, m_source.colors.quantiles);
        append(numbers, m_reference.colors.quantiles);
        append(numbers, m_match);
        for (const DenseLayer& layer : m_model.anchor_network) {
            if (&layer == &m_model.anchor_network.back())
                tell_deviation(numbers);
            numbers = transformed(layer, numbers);
            if (&layer != &m_model.anchor_network.back())
                rectify(numbers);
        }
        add(line, numbers);
        return line;
    }

    /// `hidden`: what the last layer of the anchor's network takes.
    void tell_deviation(const std::vector<float>& hidden)
    {
        std::vector<float> numbers = transformed(m_model.anchor_deviation[0], hidden);
        rectify(numbers);
        const double log_deviation = transformed(m_model.anchor_deviation[1], numbers)[0];
        m_parameters.brightness_sd_ev =
            static_cast<float>(std::min<double>(std::exp(log_deviation) / std::log(2.0), kLargestBrightnessEv));
    }

    /// b_c = mean of the running thumbnail / predicted mean of the RAW [method 2, anchor]
    void anchor()
    {
        if (!m_model.anchor)
            return;
        const std::vector<float> log_means = this->log_means();
        for (int c = 0; c < 3; ++c) {
            const double mean = sum_of(m_running.planes().plane(c), m_running.count()) / m_running.count();
            m_base_gain[c] = static_cast<float>(std::max(mean, 1e-3) / std::exp(double(log_means[c])));
        }
        if (m_trace)
            m_trace->base_gain = m_base_gain;
    }

    using Gains = std::array<float, 3>;

    /// Weights of a block that undoes gains: `gains(atom)`.
    std::vector<float> gain_weights(const BlockSelector& block, const std::function<Gains(int atom)>& gains)
    {
        PlanarThumbnail powers(m_running.size());
        power(m_running.planes(), powers.planes(), m_running.count(), m_scale.exponent,
              std::numeric_limits<float>::min());
        return candidate_weights(block, [&](int atom, Planes out) {
            const Gains scales = scales_of(gains(atom));
            power_of_inverse_gain(m_running.planes(), powers.planes(), out, m_running.count(), scales.data(),
                                  m_scale.exponent, m_scale.floor);
        });
    }

    static Gains scales_of(const Gains& gains) { return { 1 / gains[0], 1 / gains[1], 1 / gains[2] }; }

    void undo_gains(const Gains& gains)
    {
        inverse_gain(m_running.planes(), m_running.planes(), m_running.count(), scales_of(gains).data());
    }

    void choose_white_balance()
    {
        const float red = m_base_gain[0] / m_base_gain[1], blue = m_base_gain[2] / m_base_gain[1];
        const auto product = [&](const std::array<float, 2>& atom) {
            const float r = atom[0] * red, b = atom[1] * blue;
            const float one = m_model.white_stays_white ? std::min({ r, 1.0f, b }) : 1.0f;
            return Gains{ r / one, 1 / one, b / one };
        };
        m_parameters.white_balance_weights =
            gain_weights(m_model.white_balance, [&](int atom) { return product(m_model.white_balance_atoms[atom]); });
        std::array<float, 2> mixed{};
        for (int k = 0; k < m_model.dictionary_size; ++k)
            for (int i = 0; i < 2; ++i)
                mixed[i] += m_parameters.white_balance_weights[k] * m_model.white_balance_atoms[k][i];
        m_parameters.white_balance = product(mixed);
        keep_in_trained_range(m_parameters.white_balance, m_notes);
        undo_gains(m_parameters.white_balance);
        note(&SelectionTrace::after_white_balance);
    }

    void choose_gain()
    {
        const float base = m_base_gain[1] / m_parameters.white_balance[1];
        const auto alike = [](float gain) { return Gains{ gain, gain, gain }; };
        m_parameters.gain_weights =
            gain_weights(m_model.gain, [&](int atom) { return alike(m_model.gain_atoms[atom] * base); });
        float mixed = 0;
        for (int k = 0; k < m_model.dictionary_size; ++k)
            mixed += m_parameters.gain_weights[k] * m_model.gain_atoms[k];
        m_parameters.gain = mixed * base;
        keep_in_trained_range(m_parameters.gain, m_notes);
        if (!m_trace)
            return;
        undo_gains(alike(m_parameters.gain));
        clamp01(m_running.planes(), m_running.planes(), m_running.count());
        note(&SelectionTrace::after_gain);
    }

    const ModelData& m_model;
    PlanarThumbnail m_running;
    const ReferenceFeatures& m_reference;
    std::vector<std::string>* m_notes;
    SelectionTrace* m_trace;
    EncoderScale m_scale;
    ImageFeatures m_source;
    std::array<float, kMatchFeatures> m_match{};
    std::vector<float> m_fused;
    std::array<float, 3> m_base_gain{ 1, 1, 1 };
    Parameters m_parameters;
};

} // namespace

Parameters select_parameters(const ModelData& model, const Thumbnail& source, const ReferenceFeatures& reference,
                             std::vector<std::string>* notes, SelectionTrace* trace)
{
    return Selection(model, source, reference, notes, trace).run();
}

} // namespace srisp
