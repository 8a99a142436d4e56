// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The part of LibTorch that is used here: tensors, modules and gradients. <torch/torch.h> has all the rest too (data
/// loaders, layers, JIT), and each file that includes it compiles twice as long.
#include <torch/csrc/autograd/custom_function.h>
#include <torch/nn/module.h>
#include <torch/types.h>
