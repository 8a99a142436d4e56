// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The part of LibTorch that is used here: tensors, modules and gradients. <torch/torch.h> has all the rest too (data
/// loaders, layers, JIT), and each file that includes it compiles twice as long.
#include <torch/csrc/autograd/custom_function.h>
#include <torch/nn/module.h>
#include <torch/types.h>

namespace srisp::train {

/// Call first in main(): keeps freed memory in the process (LibTorch's CPU allocator gives its tensors back to the
/// kernel at every step, which costs 2/3 of the time) and sets LibTorch's threads; 0: as many as there are processors.
void set_up_process(int threads);

} // namespace srisp::train
