// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include "operators.h"

namespace srisp {

/// The operators as OpenColorIO's transforms. Throws what OpenColorIO throws.
OCIO_NAMESPACE::GroupTransformRcPtr ocio_group(const Operators& operators);

} // namespace srisp
