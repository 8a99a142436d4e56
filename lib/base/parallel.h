// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <OpenImageIO/function_view.h>

namespace srisp {

/// Calls task(i) for each i of [0, count), on the caller's thread and OpenImageIO's, `threads` of them at most (0: as
/// many as its attribute "threads" says); returns when all are done. What a task throws is thrown here, whichever
/// thread ran it, once all that had begun have ended; the others are left out then. (OpenImageIO's own parallel_for
/// forgets it, and the caller would go on with half a result.)
void parallel_tasks(std::int64_t count, int threads, OIIO::function_view<void(std::int64_t)> task);

} // namespace srisp
