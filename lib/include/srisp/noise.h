// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <srisp/camera.h>
#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/mosaic.h>
#include <srisp/reference.h>

namespace srisp {

/// A sensor's noise at one ISO: the variance of a value v in [0,1] (0: black, 1: white) is shot · v + read, for R, G, B
/// each. An electron is `shot` of the range.
struct NoiseModel {
    std::array<double, 3> shot{}, read{};
};

/// Errors: a figure that is not a number of [0,1].
SRISP_API Status check_noise(const NoiseModel& noise);

/// From a reference's NoiseProfile: one pair for all colours, or pairs for R, G, B. Errors: there is none, or it has
/// another count of figures, or figures that cannot be.
SRISP_API Expected<NoiseModel> profile_noise(const CameraFacts& facts);

/// Of a reference: from its NoiseProfile where profile_noise can use it. Else it is estimated from the mosaic in the
/// file at the reference's path, which is read again (docs/research/noise_estimation.md says how well that does): from
/// blocks that are flat or slopes, by a robust fit of variance over brightness. `isolate`: as for load_reference.
/// Errors name the file and say why there is neither: images of three channels (linear EXR and TIFF, LinearRaw), lossy
/// DNGs, pictures with too few flat blocks or too small a range of brightness, a file that has changed since, and what
/// load_reference says.
SRISP_API Expected<NoiseModel> reference_noise(const Reference& reference, bool isolate = true);

/// From darktable's noiseprofiles.json (version 0), which holds a and b of a · v + b for many cameras and ISOs. The
/// camera is found by make and model, case and spaces ignored, with or without the make before the model. Between two
/// ISOs a and b are interpolated linearly, as darktable does; entries to skip are skipped; figures below 0, which its
/// fits sometimes have, count as 0. Errors begin with the file's name: it cannot be read or is no such file, unknown
/// cameras (the near ones listed), an ISO outside of the camera's.
SRISP_API Expected<NoiseModel> darktable_noise(const std::string& path, const std::string& make,
                                               const std::string& model, double iso);

/// Drawn from the line of Brooks et al. 2019 ("Unprocessing images"), the same for all colours:
/// ln shot ~ U(ln 1e-4, ln 0.012), ln read = 2.18 ln shot + 1.20 + N(0, 0.26).
SRISP_API NoiseModel upi_noise(std::uint64_t seed);

/// Below so many electrons the shot noise is Poisson's; from there on a normal distribution of the same variance.
constexpr int kPoissonElectrons = 64;

/// Adds noise to a mosaic in place; values may leave [0,1]. Values below 0 have read noise only. `place`: where the
/// plane lies in the whole image. Each pixel's noise depends on the seed and on its place in the whole image alone: the
/// same bits for any cut into pieces, any order, number of threads and instruction set. `threads` 0: as many as
/// OpenImageIO uses. Errors: those of check_noise; NaN or infinity in the plane (with its place; other pixels have
/// changed by then).
///
/// Random bits: Philox4x32-10 (Salmon et al. 2011) with the seed as its key. Shot noise of few electrons is found by
/// inversion of the exact distribution at 32 random bits.
SRISP_API Status add_noise(MutablePlaneView plane, MosaicPlace place, const NoiseModel& noise, std::uint64_t seed,
                           int threads = 0);

} // namespace srisp
