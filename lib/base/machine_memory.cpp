// SPDX-License-Identifier: Apache-2.0
#include "base/machine_memory.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace srisp {

/// A number of Slurm's; 0: there is none.
static std::uint64_t number(const char* variable)
{
    const char* const text = std::getenv(variable);
    return text ? std::strtoull(text, nullptr, 10) : 0;
}

std::uint64_t machine_memory()
{
    const std::uint64_t all = std::uint64_t(::sysconf(_SC_PHYS_PAGES)) * std::uint64_t(::sysconf(_SC_PAGE_SIZE));
    const std::uint64_t mb =
        std::max(number("SLURM_MEM_PER_NODE"),
                 number("SLURM_MEM_PER_CPU") * std::max<std::uint64_t>(number("SLURM_CPUS_PER_TASK"), 1));
    return mb ? std::min(all, mb << 20) : all;
}

} // namespace srisp
