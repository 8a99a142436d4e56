// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scores.h"

namespace srisp::tool {

/// A table of one line for each image and method, by RFC 4180; numbers without a value are empty.
std::string to_csv(const Evaluation& evaluation);

} // namespace srisp::tool
