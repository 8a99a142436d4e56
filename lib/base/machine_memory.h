// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace srisp {

/// Bytes of this machine, or of what Slurm gives to this task of it.
std::uint64_t machine_memory();

} // namespace srisp
