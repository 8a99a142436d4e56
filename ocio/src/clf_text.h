// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/ocio_transform.h>

#include "operators.h"

namespace srisp {

/// A CLF file. (OpenColorIO writes them, too, but takes seconds for a cube of 65³.)
std::string clf_text(const Operators& operators, const ClfLabel& label);

/// A text inside of a CLF file. What XML cannot hold (control characters) becomes '?'.
std::string clf_escaped(const std::string& text);

} // namespace srisp
