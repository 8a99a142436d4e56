// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <limits>

#include <doctest/doctest.h>

#include "kernels/pixel_pipeline.h"
#include "kernels/pointwise.h"
#include "lib/kernels/random_tone_map.h"
#include "lib/kernels/test_planes.h"

using namespace srisp;

namespace {

constexpr std::size_t kCount = 997;

using Run = void (*)(const PixelPipeline&, const ToneTable*, const float*, float*, std::size_t);

PixelPipeline made_up_pipeline(Run direction)
{
    const bool forward = direction == forward_pixels;
    const Matrix3 color{ 1.6f, -0.4f, -0.2f, -0.3f, 1.5f, -0.2f, 0.05f, -0.6f, 1.55f };
    return { pack_pixel_tone_map(random_tone_layers()),
             { color, forward ? 1 / 2.2f : 2.2f, { 0.5f, 1, 0.7f }, { 0.8f, 0.8f, 0.8f }, forward } };
}

std::vector<float> random_rgb(float low, float high)
{
    std::vector<float> rgb(3 * kCount);
    Random random(3);
    for (float& value : rgb)
        value = random.uniform(low, high);
    return rgb;
}

std::vector<float> run(Run direction, const PixelPipeline& pipeline, const ToneTable* table,
                       const std::vector<float>& rgb)
{
    std::vector<float> out(rgb.size());
    direction(pipeline, table, rgb.data(), out.data(), rgb.size() / 3);
    return out;
}

/// The whole pipeline by the blocks in plain C++.
std::vector<float> in_plain_cpp(Run direction, const PixelPipeline& p, const std::vector<float>& rgb)
{
    TestPlanes v{ rgb.size() / 3 };
    split_channels(rgb.data(), v.planes(), v.count);
    if (direction == forward_pixels)
        scalar::before_tone_map(p.blocks, v.planes(), v.planes(), v.count);
    tone_map_in_plain_cpp(p.tone_map, v.planes(), v.planes(), v.count);
    clamp01(v.planes(), v.planes(), v.count);
    if (direction == reverse_pixels)
        scalar::after_tone_map(p.blocks, v.planes(), v.planes(), v.count);
    std::vector<float> out(rgb.size());
    join_channels(v.planes(), out.data(), v.count);
    return out;
}

std::unique_ptr<ToneTable> table_of(const PixelPipeline& pipeline)
{
    auto table = std::make_unique<ToneTable>();
    for (int red = 0; red < ToneTable::kSide; ++red)
        table->fill_plane(pipeline.tone_map, red);
    return table;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

} // namespace

TEST_CASE("the whole pointwise pipeline is the same on every instruction set as its blocks in plain C++")
{
    for (const Run direction : { Run(reverse_pixels), Run(forward_pixels) }) {
        const PixelPipeline pipeline = made_up_pipeline(direction);
        const std::vector<float> rgb = random_rgb(0, 1), expected = in_plain_cpp(direction, pipeline, rgb);
        on_each_instruction_set([&] {
            const std::vector<float> out = run(direction, pipeline, nullptr, rgb);
            const Difference difference = compare(out, expected);
            INFO(difference.text);
            CHECK(difference.largest <= 3e-5);
            std::vector<float> in_place = rgb;
            direction(pipeline, nullptr, in_place.data(), in_place.data(), kCount);
            CHECK(in_place == out);
        });
    }
}

TEST_CASE("a pixel has the same bits wherever it lies, with a table and without, and no other memory is touched")
{
    const PixelPipeline pipeline = made_up_pipeline(reverse_pixels);
    std::vector<float> rgb = random_rgb(-0.05f, 1.05f);
    on_each_instruction_set([&] {
        const std::unique_ptr<ToneTable> made = table_of(pipeline);
        for (const bool with_table : { false, true }) {
            const ToneTable* const table = with_table ? made.get() : nullptr;
            const std::vector<float> all = run(reverse_pixels, pipeline, table, rgb);
            for (const int count : { 1, 5, 24, 49, 100 })
                for (int x = 0; x + count <= 300; x += 61) {
                    std::vector<float> part(3 * count + 2, -7.0f);
                    reverse_pixels(pipeline, table, &rgb[3 * x], part.data() + 1, count);
                    CHECK(std::equal(part.begin() + 1, part.end() - 1, all.begin() + 3 * x));
                    CHECK(part.front() == -7.0f);
                    CHECK(part.back() == -7.0f);
                }
        }
    });
}

TEST_CASE("a table has the tone map's values at its points and stays near between them")
{
    for (const Run direction : { Run(reverse_pixels), Run(forward_pixels) }) {
        const PixelPipeline pipeline = made_up_pipeline(direction);
        const std::vector<float> rgb = random_rgb(0, 1);
        std::vector<float> points;
        constexpr int last = ToneTable::kSide - 1;
        for (const int at : { 0, 1, 15, last - 1, last })
            for (const int other : { 0, 9, last })
                for (const int value : { at, other, last - at })
                    points.push_back(value / float(last));
        on_each_instruction_set([&] {
            const std::unique_ptr<ToneTable> table = table_of(pipeline);
            const Difference between =
                compare(run(direction, pipeline, table.get(), rgb), run(direction, pipeline, nullptr, rgb));
            INFO(between.text);
            CHECK(between.largest <= 2e-3);
            CHECK(between.largest > 0);
            if (direction == forward_pixels)
                return; // whose points lie behind a power
            const Difference at =
                compare(run(direction, pipeline, table.get(), points), run(direction, pipeline, nullptr, points));
            INFO(at.text);
            CHECK(at.largest <= 1e-6);
        });
    }
}

TEST_CASE("what is outside the unit cube counts as its nearest, and what is no number as 0")
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const std::pair<float, float> odd_and_counted[] = { { nan, 0 },    { infinity, 1 }, { -infinity, 0 },
                                                        { 65504, 1 },  { 3e38f, 1 },    { -1e-30f, 0 },
                                                        { -0.25f, 0 }, { 1.5f, 1 },     { 1.0000001f, 1 } };
    for (const Run direction : { Run(reverse_pixels), Run(forward_pixels) }) {
        const PixelPipeline pipeline = made_up_pipeline(direction);
        const std::vector<float> inside = random_rgb(0, 1);
        on_each_instruction_set([&] {
            const std::unique_ptr<ToneTable> made = table_of(pipeline);
            for (const ToneTable* const table : std::initializer_list<const ToneTable*>{ nullptr, made.get() })
                for (const auto& [odd, counted] : odd_and_counted) {
                    INFO("value ", odd);
                    std::vector<float> with_odd = inside, with_counted = inside;
                    with_odd[3 * 30 + 1] = odd;
                    with_counted[3 * 30 + 1] = counted;
                    CHECK(same_bits(run(direction, pipeline, table, with_odd),
                                    run(direction, pipeline, table, with_counted)));
                }
        });
    }
}
