// SPDX-License-Identifier: Apache-2.0
#include "base/spare_memory.h"

#include <algorithm>

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("memory that came back is used again, and what is held is not")
{
    SpareMemory memory;
    auto first = memory.floats(1000);
    const float* const place = first.get();
    const auto second = memory.floats(1000);
    CHECK(second.get() != place);
    auto copy = first;
    first.reset();
    const auto third = memory.floats(1000);
    CHECK(third.get() != place);
    copy.reset();
    auto again = memory.floats(900); // of nearly the size
    CHECK(again.get() == place);
    again.reset();
    CHECK(memory.floats(100).get() != place); // much less would waste it
    CHECK(memory.floats(1001).get() != place);
}

TEST_CASE("memory may come back when its owner has gone")
{
    std::shared_ptr<float[]> floats;
    {
        SpareMemory memory;
        floats = memory.floats(10);
    }
    std::fill_n(floats.get(), 10, 1.0f);
    floats.reset();
}
