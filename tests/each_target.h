// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <doctest/doctest.h>

#include "force_targets.h"
#include "kernels/bf16_convolution.h"

/// Calls `body` once per instruction set that this machine has and the build contains, with dispatch forced to it.
template<class Body> void on_each_instruction_set(Body body)
{
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        force_targets(target);
        INFO("instruction set ", std::string(hwy::TargetName(target)));
        body();
#ifdef SRISP_SANITIZED
        break; // the sanitizers make kernels 50 times slower; the widest vectors reach furthest past an end
#endif
    }
    force_targets(0);
}

/// Calls `body` for each way in which Precision::fast is computed on this machine.
template<class Body> void on_each_fast_method(Body body)
{
    body();
    if (!srisp::has_bf16())
        return;
    force_targets(HWY_AVX2);
    INFO("without bf16");
    body();
    force_targets(0);
}
