// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <hwy/highway.h>

/// Lets dispatch choose among these instruction sets only; 0: all that the machine has.
inline void force_targets(std::int64_t targets)
{
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}
