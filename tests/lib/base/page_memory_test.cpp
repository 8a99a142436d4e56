// SPDX-License-Identifier: Apache-2.0
#include "base/page_memory.h"

#include <algorithm>

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("pages go back to the system up to a place, and the rest stays")
{
    constexpr std::size_t size = std::size_t(11) << 20, end = std::size_t(7) << 20;
    const auto memory = PageMemory::create(size);
    REQUIRE(memory);
    std::fill_n(memory->data(), size, (unsigned char)(7));
    memory->forget_before(end);
    CHECK(memory->data()[0] == 0); // a fresh page
    CHECK(memory->data()[end - (std::size_t(2) << 20) - 1] == 0);
    CHECK(std::count(memory->data() + end, memory->data() + size, 7) == std::ptrdiff_t(size - end));
    memory->forget_before(end / 2); // has gone already
    CHECK(memory->data()[end] == 7);
    memory->forget_before(size);
    CHECK(std::count(memory->data(), memory->data() + size, 0) == std::ptrdiff_t(size));
}

TEST_CASE("more memory than any machine has is none")
{
    CHECK(!PageMemory::create(std::size_t(1) << 60));
}
