// SPDX-License-Identifier: Apache-2.0
#include "machine_share.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

namespace srisp::tool {

namespace {

/// A number of Slurm's; 0: there is none.
std::uint64_t number(const char* variable)
{
    const char* const text = std::getenv(variable);
    return text ? std::strtoull(text, nullptr, 10) : 0;
}

/// Bytes of this machine, or of what Slurm gives to this task of it.
std::uint64_t memory_here()
{
    const std::uint64_t all = std::uint64_t(::sysconf(_SC_PHYS_PAGES)) * std::uint64_t(::sysconf(_SC_PAGE_SIZE));
    const std::uint64_t mb =
        std::max(number("SLURM_MEM_PER_NODE"),
                 number("SLURM_MEM_PER_CPU") * std::max<std::uint64_t>(number("SLURM_CPUS_PER_TASK"), 1));
    return mb ? std::min(all, mb << 20) : all;
}

} // namespace

std::uint64_t memory_limit(double asked_gb)
{
    return asked_gb > 0 ? std::uint64_t(asked_gb * 1e9) : memory_here() / 4;
}

unsigned images_at_a_time(int asked)
{
    return asked > 0 ? unsigned(asked) : std::max(std::thread::hardware_concurrency(), 1u);
}

} // namespace srisp::tool
