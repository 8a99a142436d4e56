// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scores.h"

namespace srisp::tool {

/// A table for people: each rendering with all methods; each camera, too, if `by_camera`.
std::string score_table(const Evaluation& evaluation, bool by_camera);

} // namespace srisp::tool
