// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace srisp::train {

/// Call first in main(): keeps freed memory in the process (LibTorch's CPU allocator gives its tensors back to the
/// kernel at every step, which costs 2/3 of the time) and sets LibTorch's threads; 0: as many as there are processors.
void set_up_process(int threads);

} // namespace srisp::train
