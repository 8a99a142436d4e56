// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <srisp/apply.h>
#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/parameters.h>

namespace srisp {

class Model;

/// v + φ(v) of single colours, **not** clamped: for those who tabulate the tone map of a pointwise model. `rgb` and
/// `out`: `count` × 3 floats, display-encoded; they may be the same memory. Uses OpenImageIO's threads; any number of
/// threads may call it. Errors: a model whose tone map looks at neighbours (kernel size other than 1); parameters of
/// another model. [method 1]
SRISP_API Status tone_map_values(const Model& model, const Parameters& parameters, Direction direction,
                                 const float* rgb, std::int64_t count, float* out);

} // namespace srisp
