// SPDX-License-Identifier: Apache-2.0
#include "base/guarded.h"

#include <vector>

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("what a step throws becomes an error that says of what")
{
    const auto message = [](auto step, const char* name) {
        return guarded("photo", name, [&]() -> Status { return step(), Status(); }).error().message;
    };
    CHECK(message([] {}, "a.jpg").empty());
    CHECK(message([] { throw std::runtime_error("no such thing"); }, "a.jpg") == "photo 'a.jpg': no such thing");
    CHECK(message([] { throw std::bad_alloc(); }, "a.jpg") == "photo 'a.jpg': not enough memory");
    CHECK(message([] { std::vector<int>().reserve(std::size_t(-1)); }, "") == "photo: not enough memory");
    CHECK(message([] { throw 1; }, "") == "photo: unknown exception");
}
