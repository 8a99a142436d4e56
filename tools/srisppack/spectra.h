// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "pack/training_pack.h"

namespace srisp::tool {

/// Spectra measured at the same wavelengths.
struct SpectraTable {
    std::string where;                        ///< "'path'", for messages
    std::string manufacturer, model, licence; ///< "" if not stated
    std::vector<std::string> columns;
    std::vector<double> wavelengths_nm;      ///< rising
    std::vector<std::vector<double>> values; ///< [column][wavelength]
};

/// Reads a spectral file as the rawtoaces data set has them (JSON with `header` and `spectral_data`; 380 nm: a list of
/// one number per column). Fails with file and wavelength: no such file, no such table, other lengths, numbers that are
/// not finite, less than 400 … 700 nm.
SpectraTable read_spectra_json(const std::string& path);

/// Reads a table whose first column is `wavelength_nm`, and each other one a spectrum.
SpectraTable read_spectra_csv(const std::string& path);

/// A spectrum at the wavelengths of a pack, linear between those measured, 0 beyond them.
using Spectrum = std::array<double, kPackWavelengths>;
Spectrum resampled(const SpectraTable& table, std::size_t column);

/// The reflectance per unit of linear sRGB R, G, B: [3][wavelength]. It lies in the first three principal components
/// (not centred, so that black is black) of `measured`, and `observer` (x̄, ȳ, z̄) sees under `d65` exactly that colour,
/// with a perfect reflector as Y = 1.
std::array<Spectrum, 3> reflectance_basis(const std::vector<Spectrum>& measured,
                                          const std::array<Spectrum, 3>& observer, const Spectrum& d65);

} // namespace srisp::tool
