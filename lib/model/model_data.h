// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <srisp/model.h>

#include "base/matrix3.h"

namespace srisp {

constexpr int kToneLayers = 4;

/// y = weight · x + bias; weight is [outputs, inputs].
struct Linear {
    int inputs = 0, outputs = 0;
    std::vector<float> weight, bias;
};

/// A convolution layer: weight is [outputs, inputs, kernel, kernel], or [atoms, outputs, …] in a dictionary, and bias
/// likewise.
struct ConvolutionWeights {
    int inputs = 0, outputs = 0, taps = 0;
    std::vector<float> weight, bias;
};

using EncoderWeights = std::vector<ConvolutionWeights>;

/// What chooses the parameters of one block: project and head once per dictionary (tone: one per layer).
struct BlockSelector {
    EncoderWeights encoder;
    std::vector<Linear> project, head;
};

using ToneDictionary = std::array<ConvolutionWeights, kToneLayers>;

/// A model file's content, checked and in float32. Names as in the file [method 3].
struct ModelData {
    std::string name, path, hash;
    std::map<std::string, std::string> metadata;
    int kernel_size = 3, dictionary_size = 5;
    bool perceptual_encoder_input = true;

    EncoderWeights source_encoder, reference_encoder;
    std::optional<Linear> source_statistics, reference_statistics, anchor;
    std::vector<Linear> anchor_network; ///< empty in srisp-1
    Linear fuse;
    BlockSelector tone, gamma, color, white_balance, gain;

    std::vector<float> gain_atoms, gamma_atoms;
    std::vector<std::array<float, 2>> white_balance_atoms; ///< (g_r, g_b)
    std::vector<Matrix3> color_atoms;                      ///< C, rows normalised to sum to 1
    ToneDictionary tone_reverse, tone_forward;

    /// Whether the least white-balance gain is 1; in srisp-1 the green one is.
    bool white_stays_white() const { return !anchor_network.empty(); }
    /// Whether the forward pass sets white that the RAW has clipped in some channels to the brightest one: with gains
    /// of at least 1 it is clipped in all of them anyway.
    bool rebuilds_highlights(float global_gain) const { return white_stays_white() && 1 / global_gain > 1; }
};

/// What a loaded model holds: for the rooms of this library, not for those who use it.
inline const ModelData& model_data(const Model& model)
{
    return *model.m_data;
}

} // namespace srisp
