// SPDX-License-Identifier: Apache-2.0
#include "machine_share.h"

#include <algorithm>
#include <thread>

#include "base/machine_memory.h"

namespace srisp::tool {

std::uint64_t memory_limit(double asked_gb)
{
    return asked_gb > 0 ? std::uint64_t(asked_gb * 1e9) : machine_memory() / 4;
}

unsigned images_at_a_time(int asked)
{
    return asked > 0 ? unsigned(asked) : std::max(std::thread::hardware_concurrency(), 1u);
}

} // namespace srisp::tool
