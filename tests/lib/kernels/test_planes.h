// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <doctest/doctest.h>

#include "base/planes.h"
#include "each_target.h"
#include "image_compare.h"
#include "random_model.h"

// What tests of kernels on planes share.

/// Three planes with the room that the kernels need.
struct TestPlanes {
    std::size_t count;
    std::vector<float> values = std::vector<float>(3 * (count + srisp::kRowSlack));

    srisp::Planes planes() { return { values.data(), static_cast<std::ptrdiff_t>(count + srisp::kRowSlack) }; }
    std::vector<float> used()
    {
        std::vector<float> result;
        for (int c = 0; c < 3; ++c)
            result.insert(result.end(), planes().plane(c), planes().plane(c) + count);
        return result;
    }
};

inline TestPlanes random_planes(std::size_t count, float low, float high)
{
    TestPlanes image{ count };
    Random random(3);
    for (int c = 0; c < 3; ++c)
        for (std::size_t x = 0; x < count; ++x)
            image.planes().plane(c)[x] = random.uniform(low, high);
    return image;
}

template<class Vector, class Scalar>
void check_same(float low, float high, double tolerance, Vector vector, Scalar plain)
{
    TestPlanes in = random_planes(997, low, high), expected{ 997 };
    plain(in.planes(), expected.planes(), in.count);
    on_each_instruction_set([&] {
        TestPlanes out{ in.count };
        vector(in.planes(), out.planes(), in.count);
        const Difference difference = compare(out.used(), expected.used());
        INFO(difference.text);
        CHECK(difference.largest_relative <= tolerance);
        TestPlanes in_place = in;
        vector(in_place.planes(), in_place.planes(), in.count);
        CHECK(in_place.used() == out.used());
    });
}
