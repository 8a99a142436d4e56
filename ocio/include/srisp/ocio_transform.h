// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <OpenColorIO/OpenColorIO.h>
#include <srisp/apply.h>
#include <srisp/develop.h>
#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/parameters.h>

// The pipeline of a pointwise model as transforms of OpenColorIO. `Direction::reverse` ("unprocess") takes
// display-encoded sRGB to RAW-like camera RGB, `Direction::forward` ("process") back; values in [0,1], others are
// clamped. Exact: exponent, colour matrix, all clamps, and factors of at least 1. Tabulated: the tone map as unclamped
// v + φ(v), the highlight-preserving inverse gains, and the forward gain below 1 that rebuilds clipped highlights. The
// two directions are made apart: OpenColorIO's own inverse of one of them is not the other. Nothing throws; threads:
// safe.

namespace srisp {

class Model;

/// Points along each side of the tone map's cube.
constexpr int kSmallestLut = 5, kDefaultLut = 65, kLargestLut = 129;

/// The group of transforms. `lut_size`: kSmallestLut … kLargestLut. Errors: a model that is not pointwise, parameters
/// of another model, a size outside the limits.
SRISP_API Expected<OCIO_NAMESPACE::GroupTransformRcPtr>
make_ocio_transform(const Model& model, const Parameters& parameters, Direction direction, int lut_size = kDefaultLut);

/// What a CLF file says of itself.
struct ClfLabel {
    std::string id, name;                  ///< attributes of its ProcessList
    std::vector<std::string> descriptions; ///< one Description element each; UTF-8
};

/// The same transform as the text of a CLF file (Academy/ASC Common LUT Format, version 3): numbers come back to the
/// bit. [S-2014-006]
SRISP_API Expected<std::string> make_clf(const Model& model, const Parameters& parameters, Direction direction,
                                         const ClfLabel& label, int lut_size = kDefaultLut);

/// A development as a group of transforms, exact: a matrix, a limit where highlights are clipped, a matrix.
/// OpenColorIO's inverse of it is undo_development. Error: highlights that are blended, which is neither.
SRISP_API Expected<OCIO_NAMESPACE::GroupTransformRcPtr> make_ocio_development(const Development& development);

/// The same as the text of a CLF file.
SRISP_API Expected<std::string> make_development_clf(const Development& development, const ClfLabel& label);

} // namespace srisp
