// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/develop.h>

#include "base/matrix3.h"

namespace srisp {

/// From a development's colours to camera RGB.
inline Matrix3 undo_matrix(const Development& development)
{
    return inverse(product(development.matrix, diagonal(development.multipliers)));
}

} // namespace srisp
