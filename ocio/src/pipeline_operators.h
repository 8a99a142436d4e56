// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/apply.h>
#include <srisp/expected.h>
#include <srisp/parameters.h>

#include "operators.h"

namespace srisp {

class Model;

/// The whole pipeline [method 1]; limits and errors as make_ocio_transform says.
Expected<Operators> pipeline_operators(const Model& model, const Parameters& parameters, Direction direction,
                                       int lut_size);

} // namespace srisp
