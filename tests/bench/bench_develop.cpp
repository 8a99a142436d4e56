// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include <srisp/develop.h>

#include "bench_fixture.h"
#include "measuring.h"
#include "require.h"

using namespace srisp;

namespace {

constexpr int kRepeats = 7, kWidth = 6000;

/// Nanoseconds a pixel on one core, in place; the least of several turns, of which each starts from the picture.
double nanoseconds(const Development& development, const Picture& picture)
{
    double least = 1e9;
    Picture copy = picture;
    for (int i = 0; i < kRepeats; ++i) {
        std::memcpy(copy.rgb.data(), picture.rgb.data(), picture.rgb.size() * sizeof(float));
        const MutableImageView view = copy.mutable_view();
        least = std::min(least, seconds([&] { require(develop(development, view, view, nullptr, 1)); }));
    }
    return least * 1e9 / (double(picture.width) * picture.height);
}

} // namespace

BenchLines bench_develop(const BenchSettings& settings)
{
    const Picture picture = bench_picture(settings, kWidth, static_cast<int>(settings.megapixels * 1e6 / kWidth));
    Development development;
    development.multipliers = { 2, 1, 1.5f };
    development.matrix = { 0.7f, 0.2f, 0.1f, 0.1f, 1, -0.1f, 0, -0.2f, 1.2f };
    BenchLines lines;
    for (const auto& [name, highlights] : { std::pair("clip", Highlights::clip), std::pair("blend", Highlights::blend),
                                            std::pair("keep", Highlights::keep) }) {
        development.highlights = highlights;
        lines.push_back({ std::string("develop_") + name, nanoseconds(development, picture), "ns a pixel", "<= 10",
                          "camera RGB to scene-linear colour, one core, in place" });
    }
    return lines;
}
