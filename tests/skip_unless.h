// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>

#include <doctest/doctest.h>

/// Leaves the test, loudly, unless the condition holds; `what` (std::string) is missing. tests/run.sh counts the lines.
#define SKIP_UNLESS(condition, what)                                                                                   \
    if (!(condition)) {                                                                                                \
        std::fprintf(stderr, "SKIPPED %s:%d: needs %s\n", __FILE__, __LINE__, std::string(what).c_str());              \
        return;                                                                                                        \
    }
