// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/network/layers.h"
#include "train/network/model_settings.h"
#include "train/tensors/torch_api.h"

namespace srisp::train {

/// Where the dictionaries start [method 4, 6]. A mixture of atoms cannot leave their hull, so the atoms span what is to
/// be selected. With an anchor they are corrections around 1, without one absolute values.
struct InitialAtoms {
    torch::Tensor gamma;         ///< [K], 1.6 … 3.2
    torch::Tensor color;         ///< [K, 3, 3], matrices of different cameras
    torch::Tensor white_balance; ///< [K, 2] along the daylight–tungsten locus; merged with the gain: [K, 3]
    torch::Tensor gain;          ///< [K] log-spaced; undefined where it is merged
};

InitialAtoms initial_atoms(const ModelSettings& settings);

/// The atoms that parameters are mixed from, named as in the model file [method 3]; K atoms each.
class Dictionaries : public torch::nn::Module {
public:
    Dictionaries(const ModelSettings& settings, InitialWeights& initial);

    torch::Tensor gamma;         ///< [K]
    torch::Tensor color;         ///< [K, 3, 3]; `normalized_color` is what is used
    torch::Tensor white_balance; ///< [K, 2], (g_r, g_b); merged with the gain: [K, 3]
    torch::Tensor gain;          ///< [K]; undefined where it is merged
    std::vector<std::shared_ptr<Layer>> tone_reverse, tone_forward; ///< weight [K, O, I, k, k], bias [K, O]

    torch::Tensor normalized_color() const;
    /// The white-balance atoms as (g_r, 1, g_b), [K, 3]; merged with the gain, as they are.
    torch::Tensor channel_gains() const;

    /// All but the tone kernels, which learn as other convolutions do.
    std::vector<torch::Tensor> scalars() const;

    /// Gains and γ stay away from 0, matrices normalised and away from singular ones.
    void constrain();

private:
    void add_tone_maps(int atoms, int kernel_size, InitialWeights& initial);
};

} // namespace srisp::train
