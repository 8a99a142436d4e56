// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "base/matrix3.h"
#include "base/planes.h"
#include "force_targets.h"
#include "fuzz_target.h"

// What the targets of kernels share: inputs that are drawn, and how results on each instruction set are compared.

namespace srisp::fuzz {

/// Calls `vector`, which fills its argument, for each instruction set; `expected` is what plain C++ makes.
template<class Vector>
void check_each_target(const char* kernel, const std::vector<float>& expected, double tolerance, const Vector& vector)
{
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        force_targets(target);
        std::vector<float> out(expected.size());
        vector(out);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const double difference = std::fabs(double(out[i]) - double(expected[i]));
            if (!(difference <= tolerance * std::max(1.0, std::fabs(double(expected[i])))))
                must_hold(false, "kernels are the same as in plain C++",
                          std::string(kernel) + " on " + hwy::TargetName(target) + ": " + std::to_string(out[i]) +
                              " against " + std::to_string(expected[i]));
        }
    }
    force_targets(0);
}

/// Three planes of `count` pixels with the room that kernels need; only the pixels are taken out again.
struct Image {
    std::size_t count;
    std::vector<float> values;

    explicit Image(std::size_t pixels) : count(pixels), values(3 * (pixels + kRowSlack)) {}
    Planes planes() { return { values.data(), std::ptrdiff_t(count + kRowSlack) }; }
    void take(std::vector<float>& out)
    {
        for (std::size_t c = 0; c < 3; ++c)
            std::copy_n(planes().plane(int(c)), count, out.begin() + std::ptrdiff_t(c * count));
    }
};

inline Image drawn_image(Draws& draws, float low, float high)
{
    Image image(std::size_t(1 + draws.below(70)));
    for (int c = 0; c < 3; ++c)
        for (std::size_t x = 0; x < image.count; ++x)
            image.planes().plane(c)[x] = draws.within(low, high);
    return image;
}

inline Matrix3 drawn_matrix(Draws& draws)
{
    Matrix3 matrix{};
    for (std::size_t i = 0; i < 9; ++i)
        matrix[i] = draws.within(-0.6f, 0.6f) + (i % 4 == 0 ? 1 : 0);
    return matrix;
}

inline std::vector<float> drawn_values(Draws& draws, std::size_t count)
{
    std::vector<float> values(count);
    std::uint32_t state = draws.number<std::uint32_t>();
    for (float& value : values) {
        state = state * 1664525 + 1013904223;
        value = float(int(state >> 8) - (1 << 23)) / float(1 << 23);
    }
    return values;
}

} // namespace srisp::fuzz
