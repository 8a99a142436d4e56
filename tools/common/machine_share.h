// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace srisp::tool {

/// Bytes that images may take at a time: so many GB where they are asked for (above 0), or a quarter of this machine's,
/// or of what Slurm gives to this task of it.
std::uint64_t memory_limit(double asked_gb);

/// Images at a time: as many as are asked for (above 0), or one for each processor.
unsigned images_at_a_time(int asked);

} // namespace srisp::tool
