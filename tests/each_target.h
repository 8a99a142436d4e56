// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <doctest/doctest.h>
#include <hwy/highway.h>

/// Calls `body` once per instruction set that this machine has and the build contains, with dispatch forced to it.
template<class Body> void on_each_instruction_set(Body body)
{
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        INFO("instruction set ", std::string(hwy::TargetName(target)));
        body();
#ifdef __SANITIZE_ADDRESS__
        break; // the sanitizers make kernels 50 times slower; the widest vectors reach furthest past an end
#endif
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}
