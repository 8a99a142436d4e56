// SPDX-License-Identifier: Apache-2.0
#include "train/tensors/torch_api.h"

#include <limits>
#include <thread>

#include <malloc.h>

#include <ATen/Parallel.h>

namespace srisp::train {

void set_up_process(int threads)
{
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
    mallopt(M_TOP_PAD, 256 << 20);
    at::set_num_threads(threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency()));
}

} // namespace srisp::train
