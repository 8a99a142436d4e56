// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>

/// Path of a file of the shared test data, which lies beside the repository.
inline std::string shared_file(const std::string& name)
{
    return std::string(SRISP_TEST_SHARED) + "/" + name;
}

/// Leaves the test, loudly, where a file of the shared test data is missing. tests/run.sh counts the lines.
#define SKIP_WITHOUT_SHARED(name)                                                                                      \
    if (!std::filesystem::exists(shared_file(name))) {                                                                 \
        std::fprintf(stderr, "SKIPPED %s:%d: needs %s\n", __FILE__, __LINE__, shared_file(name).c_str());              \
        return;                                                                                                        \
    }
