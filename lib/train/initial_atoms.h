// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "model_settings.h"

#include "torch_api.h"

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

} // namespace srisp::train
