// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pack_options.h"
#include "summary.h"

namespace srisp::tool {

/// Makes the pack that the options describe. Messages on images that cannot be read go to stderr. Throws Failure and
/// Interrupted; nothing of the pack is left then.
Summary make_pack(const PackOptions& options);

} // namespace srisp::tool
