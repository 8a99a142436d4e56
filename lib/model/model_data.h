// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <srisp/expected.h>
#include <srisp/model.h>

#include "base/matrix3.h"

namespace srisp {

/// What a model file may say: at how many pixels a side selection works.
constexpr int kSelectionSizes[] = { 64, 96, 128, 256 };

constexpr int kToneLayers = 4;

/// y = weight · x + bias; weight is [outputs, inputs].
struct DenseLayer {
    int inputs = 0, outputs = 0;
    std::vector<float> weight, bias;
};

/// A convolution layer of a tone map: weight is [outputs, inputs, kernel, kernel], or [atoms, outputs, …] in a
/// dictionary, and bias likewise.
struct ConvolutionWeights {
    int inputs = 0, outputs = 0, taps = 0;
    std::vector<float> weight, bias;
};

/// Outputs of an encoder's layer whose weights lie side by side; each layer has a multiple of them.
constexpr int kEncoderGroup = 32;

/// A 3×3 convolution with stride 2: weight is [outputs / kEncoderGroup, 3, 3, inputs, kEncoderGroup], in the order in
/// which kernels read it.
struct EncoderLayer {
    int inputs = 0, outputs = 0;
    std::vector<float> weight, bias;
};

using EncoderWeights = std::vector<EncoderLayer>;

/// What chooses the parameters of one block: project and head once per dictionary (tone: one per layer).
struct BlockSelector {
    EncoderWeights encoder;
    std::vector<DenseLayer> project, head;
};

using ToneDictionary = std::array<ConvolutionWeights, kToneLayers>;

/// A model file's content, checked and in float32. Names as in the file [method 3].
struct ModelData {
    std::string name, path, hash;
    std::map<std::string, std::string> metadata;
    int kernel_size = 3, dictionary_size = 5;
    bool perceptual_encoder_input = true;
    int selection_size = 256;       ///< at how many pixels a side selection works; at most a thumbnail's
    bool white_stays_white = false; ///< the least white-balance gain is 1 (srisp-7); else the green one is (srisp-1)

    EncoderWeights source_encoder, reference_encoder;
    std::optional<DenseLayer> source_statistics, reference_statistics, anchor;
    std::vector<DenseLayer> anchor_network, anchor_deviation; ///< empty in srisp-1
    DenseLayer fuse;
    BlockSelector tone, gamma, color, white_balance, gain;

    std::vector<float> gain_atoms, gamma_atoms;
    std::vector<std::array<float, 2>> white_balance_atoms; ///< (g_r, g_b)
    std::vector<Matrix3> color_atoms;                      ///< C, rows normalised to sum to 1
    ToneDictionary tone_reverse, tone_forward;

    /// Whether the forward pass sets white that the RAW has clipped in some channels to the brightest one: with gains
    /// of at least 1 it is clipped in all of them anyway.
    bool rebuilds_highlights(float global_gain) const { return white_stays_white && 1 / global_gain > 1; }
};

/// Checks the bytes of a model file in full and brings it to float32; name, path and hash stay empty. `where` starts
/// every message ("model 'm.safetensors'").
Expected<std::unique_ptr<ModelData>> parse_model(const std::string& bytes, const std::string& where);

/// What a loaded model holds: for the rooms of this library, not for those who use it.
inline const ModelData& model_data(const Model& model)
{
    return *model.m_data;
}

} // namespace srisp
