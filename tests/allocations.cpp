// SPDX-License-Identifier: Apache-2.0
#include "allocations.h"

#if SRISP_COUNTS_ALLOCATIONS

#include <cstdio>
#include <cstdlib>
#include <new>

namespace allocations {

std::atomic<long> count{ 0 }, failing{ -1 }, live{ 0 };
std::atomic<std::size_t> least_bytes{ 0 };

namespace {

struct Summary {
    long failed = 0, told = 0, calls = 0;
    ~Summary()
    {
        if (calls > 0)
            std::printf("allocations failed: %ld, told: %ld, calls: %ld\n", failed, told, calls);
    }
} g_summary;

void* counted(void* memory)
{
    if (!memory)
        throw std::bad_alloc();
    ++live;
    return memory;
}

void check(std::size_t size)
{
    if (size >= least_bytes && ++count == failing)
        throw std::bad_alloc();
}

void give_back(void* memory)
{
    if (memory)
        --live;
    std::free(memory);
}

} // namespace

void add_to_summary(long failed, long told)
{
    g_summary.failed += failed;
    g_summary.told += told;
    ++g_summary.calls;
}

} // namespace allocations

void* operator new(std::size_t size)
{
    allocations::check(size);
    return allocations::counted(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
    allocations::check(size);
    const std::size_t unit = std::size_t(alignment);
    return allocations::counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}
void operator delete(void* memory) noexcept
{
    allocations::give_back(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    allocations::give_back(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
    allocations::give_back(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
    allocations::give_back(memory);
}

#endif
