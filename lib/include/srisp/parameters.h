// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <srisp/expected.h>
#include <srisp/export.h>

namespace srisp {

class Model;

/// The most by which a brightness is changed or is unsure, in EV.
constexpr float kLargestBrightnessEv = 20;

/// What `select` chooses for one photo and one reference: a few hundred bytes that can be printed, edited, replayed and
/// held over a sequence. `gain`, `white_balance`, `color` and `gamma` are final values and win as written; the weights
/// of these four are a record only. The tone kernels are mixed from the model by `tone_weights` when they are needed.
struct Parameters {
    std::array<std::vector<float>, 4> tone_weights; ///< per tone layer; dictionary_size weights that sum to 1
    std::vector<float> gamma_weights, color_weights, white_balance_weights, gain_weights;
    float gamma = 1;                                         ///< exponent γ of the reverse pass, > 0
    std::array<float, 9> color{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }; ///< C, row-major, camera RGB → linear sRGB
    std::array<float, 3> white_balance{ 1, 1, 1 };           ///< forward multipliers of R, G, B, > 0
    float gain = 1;                                          ///< forward multiplier g, > 0
    /// How unsure the brightness of the result is: the standard deviation of its error, 0 to kLargestBrightnessEv. None
    /// for models that do not tell it.
    std::optional<float> brightness_sd_ev;
    float brightness_ev = 0; ///< by how much `gain` makes the result brighter than `select` chose it; a record only
    std::string model_name, model_hash;         ///< Model::name and Model::hash
    std::string reference_name, reference_hash; ///< base name of the file and hash of its bytes; may be empty
};

/// Parameters as JSON text (an object; floats with 9 digits, so they come back to the bit). `indent` < 0 gives one
/// line.
SRISP_API std::string to_json(const Parameters& parameters, int indent = 2);

/// Reads what `to_json` wrote, or a line that `srisptool --srisp-params` printed, edited or not. `where` names the
/// source of the text in messages. Errors: not JSON, unknown or missing keys (the near ones listed), wrong types or
/// lengths, values that are not finite or not > 0, singular C.
SRISP_API Expected<Parameters> parameters_from_json(const std::string& text, const std::string& where);

/// Whether these parameters were chosen with this model and can be applied: an error if hash or number of weights
/// differ, gain, gamma or white balance are not finite and > 0, or C is singular.
SRISP_API Status check_parameters(const Parameters& parameters, const Model& model);

} // namespace srisp
