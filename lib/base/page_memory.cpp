// SPDX-License-Identifier: Apache-2.0
#include "base/page_memory.h"

#include <algorithm>
#include <cstdint>

#include <sys/mman.h>

namespace srisp {

// A huge page: it is given back whole, since taking a part out of one costs more than it gives.
static constexpr std::size_t kStep = std::size_t(2) << 20;

std::unique_ptr<PageMemory> PageMemory::create(std::size_t size)
{
    void* const memory = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED)
        return nullptr;
    ::madvise(memory, size, MADV_HUGEPAGE); // where there are none: pages as they are
    return std::unique_ptr<PageMemory>(new PageMemory(static_cast<unsigned char*>(memory), size));
}

PageMemory::~PageMemory()
{
    ::munmap(m_data, m_size);
}

void PageMemory::forget_before(std::size_t end)
{
    const std::size_t beyond = reinterpret_cast<std::uintptr_t>(m_data + end) % kStep;
    const std::size_t whole = end == m_size ? end : end - std::min(beyond, end);
    if (whole <= m_forgotten)
        return;
    ::madvise(m_data + m_forgotten, whole - m_forgotten, MADV_DONTNEED);
    m_forgotten = whole;
}

} // namespace srisp
