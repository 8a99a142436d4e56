// SPDX-License-Identifier: Apache-2.0
#include "allocations.h"

#if SRISP_COUNTS_ALLOCATIONS

#include <cstdlib>
#include <new>

namespace allocations {

std::atomic<long> count{ 0 }, failing{ -1 };
std::atomic<std::size_t> least_bytes{ 0 };

} // namespace allocations

void* operator new(std::size_t size)
{
    if (size >= allocations::least_bytes && ++allocations::count == allocations::failing)
        throw std::bad_alloc();
    if (void* memory = std::malloc(size))
        return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory);
}

#endif
