// SPDX-License-Identifier: Apache-2.0
#include "base/hashes.h"

#include <cstdio>

#include <doctest/doctest.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

TEST_CASE("xxh64 is what libxxhash computes, for every length of tail")
{
    std::string bytes;
    for (int size = 0; size < 300; ++size) {
        char expected[32];
        std::snprintf(expected, sizeof expected, "xxh64:%016llx",
                      static_cast<unsigned long long>(XXH64(bytes.data(), bytes.size(), 0)));
        CHECK(srisp::xxh64_of_bytes(bytes.data(), bytes.size()) == expected);
        bytes += char(size * 37 + 200);
    }
}
