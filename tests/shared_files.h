// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "skip_unless.h"

/// Path of a file of the shared test data, which lies beside the repository.
inline std::string shared_file(const std::string& name)
{
    return std::string(SRISP_TEST_SHARED) + "/" + name;
}

/// Leaves the test where a file of the shared test data is missing.
#define SKIP_WITHOUT_SHARED(name) SKIP_UNLESS(std::filesystem::exists(shared_file(name)), shared_file(name))
