// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/network/anchor_network.h"
#include "train/network/dictionaries.h"
#include "train/network/layers.h"
#include "train/network/model_settings.h"
#include "train/network/unprocessor.h"

namespace srisp::train {

/// What happens inside a selection, step by step, by the names of the golden files: source_statistics [N, 12],
/// source_features [N, 128], fused_features, after_tone [N, 3, H, W], …
using Trace = std::map<std::string, torch::Tensor>;

/// SRISP [method 1, 2] and those of its ablations and baselines that share its pipeline (ModelSettings). Its named
/// parameters are the tensors of the model file.
class Network : public Unprocessor {
public:
    /// `settings` are taken as `resolved()` says.
    Network(const ModelSettings& settings, std::uint64_t seed);

    torch::Tensor reverse(const torch::Tensor& source, const torch::Tensor& reference,
                          ChosenParameters* choice = nullptr) override;
    torch::Tensor apply_reverse(const torch::Tensor& image, const ChosenParameters& choice) override;
    torch::Tensor process(const torch::Tensor& raw, const ChosenParameters& choice) override;
    /// The atoms but those of the tone map, and what a static selection learns.
    std::vector<torch::Tensor> dictionary_parameters() override;
    std::vector<torch::Tensor> anchor_parameters() override;
    int selection_size() const override { return m_settings.selection_size; }
    void constrain() override;

    /// `reverse` that notes what happens on the way.
    torch::Tensor traced_reverse(const torch::Tensor& source, const torch::Tensor& reference, ChosenParameters& choice,
                                 Trace* trace);

    const ModelSettings& settings() const { return m_settings; }
    bool has_anchor() const { return m_anchor != nullptr; }
    /// A [3, 24] and a [3]; only where there is an anchor.
    void set_anchor(const torch::Tensor& weight, const torch::Tensor& bias);
    /// Null where the anchor is a line alone.
    AnchorNetwork* anchor_network() const { return m_anchor_network.get(); }
    /// How sure the anchor's network is; null where there is none.
    AnchorDeviation* anchor_deviation() const { return m_anchor_deviation.get(); }

private:
    friend class SelectionRun;

    ModelSettings m_settings;
    bool m_perceptual;
    std::shared_ptr<FeatureEncoder> m_source_encoder, m_reference_encoder; ///< null: no selection by these
    std::shared_ptr<Layer> m_source_statistics, m_reference_statistics;    ///< null: no statistics branch
    std::shared_ptr<Layer> m_anchor, m_fuse;
    std::shared_ptr<AnchorNetwork> m_anchor_network;
    std::shared_ptr<AnchorDeviation> m_anchor_deviation; ///< where there is a network
    std::shared_ptr<BlockSelector> m_tone, m_gamma, m_color, m_white_balance, m_gain;
    std::shared_ptr<Dictionaries> m_dictionaries;
};

} // namespace srisp::train
