// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <OpenImageIO/parallel.h>

namespace srisp {

/// Calls task(i) for each i of [0, count), on the caller's thread and OpenImageIO's, `threads` of them at most (0: as
/// many as its attribute "threads" says); returns when all are done.
template<class Task> void parallel_tasks(std::int64_t count, int threads, const Task& task)
{
    // Each item is worth a thread; OpenImageIO by itself gives a thread 1,024 of them at least.
    constexpr std::size_t items_per_thread = 1;
    OIIO::parallel_for(
        std::int64_t(0), count, [&task](std::int64_t i) { task(i); },
        OIIO::paropt(threads, OIIO::paropt::SplitDir::Y, items_per_thread));
}

} // namespace srisp
