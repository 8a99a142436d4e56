// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "spectra.h"

namespace srisp::tool {

/// The reflectance per unit of linear sRGB R, G, B: [3][wavelength]. It lies in the first three principal components
/// (not centred, so that black is black) of `measured`, and `observer` (x̄, ȳ, z̄) sees under `d65` exactly that colour,
/// with a perfect reflector as Y = 1.
std::array<Spectrum, 3> reflectance_basis(const std::vector<Spectrum>& measured,
                                          const std::array<Spectrum, 3>& observer, const Spectrum& d65);

} // namespace srisp::tool
