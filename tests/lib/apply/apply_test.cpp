// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <doctest/doctest.h>

#include "apply_fixture.h"
#include "each_target.h"
#include "image_compare.h"

using namespace srisp;

namespace {

/// The tone map written down once more as the method says it, in double and without tiles.
std::vector<double> tone_mapped(const Fixture& fixture, const Image& image, const ModelFile& file)
{
    std::vector<double> v(image.values.begin(), image.values.end());
    std::vector<double> in = v;
    int inputs = 3;
    const int taps = fixture.model->kernel_size() * fixture.model->kernel_size();
    for (int l = 0; l < 4; ++l) {
        const std::string name = "dictionary.tone_reverse." + std::to_string(l);
        const std::vector<float>& weight = file.tensors.at(name + ".weight").values;
        const std::vector<float>& bias = file.tensors.at(name + ".bias").values;
        const int outputs = l < 3 ? 32 : 3;
        std::vector<double> out(std::size_t(image.width) * image.height * outputs);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int o = 0; o < outputs; ++o) {
                    double sum = 0;
                    for (int k = 0; k < 5; ++k) {
                        double atom = bias[k * outputs + o];
                        for (int i = 0; i < inputs; ++i)
                            for (int t = 0; t < taps; ++t) {
                                const int sx = std::clamp(x + (taps == 1 ? 0 : t % 3 - 1), 0, image.width - 1);
                                const int sy = std::clamp(y + (taps == 1 ? 0 : t / 3 - 1), 0, image.height - 1);
                                atom += weight[((k * outputs + o) * inputs + i) * taps + t] *
                                        in[(std::size_t(sy) * image.width + sx) * inputs + i];
                            }
                        sum += fixture.parameters.tone_weights[l][k] * atom;
                    }
                    out[(std::size_t(y) * image.width + x) * outputs + o] = l < 3 ? std::max(sum, 0.0) : sum;
                }
        in = out;
        inputs = outputs;
    }
    for (std::size_t i = 0; i < v.size(); ++i)
        v[i] = std::clamp(v[i] + in[i], 0.0, 1.0);
    return v;
}

} // namespace

TEST_CASE("the tone map equals a plain one in double, borders included")
{
    Fixture fixture;
    fixture.parameters.color = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    fixture.parameters.gamma = fixture.parameters.gain = 1;
    fixture.parameters.white_balance = { 1, 1, 1 };
    const Image source = random_image(7, 27);
    const std::vector<double> expected = tone_mapped(fixture, source, random_model(3, 1));
    on_each_instruction_set([&] {
        for (const Precision precision : { Precision::float32, Precision::fast }) {
            const auto applier = fixture.applier(Direction::reverse, precision);
            const Difference difference = compare(applied(*applier, source).values, expected);
            INFO((precision == Precision::fast ? "fast: " : "float32: "), difference.text);
            CHECK(difference.largest <= (precision == Precision::fast && has_bf16() ? 5e-4 : 1e-5));
        }
    });
}

TEST_CASE("fast stays near float32, and is something else")
{
    const Fixture fixture;
    on_each_fast_method([&] {
        for (const Direction direction : { Direction::reverse, Direction::forward }) {
            const Image source = random_image(200, 300);
            const Image plain = applied(*fixture.applier(direction), source);
            const Image fast = applied(*fixture.applier(direction, Precision::fast), source);
            const Difference difference = compare(fast.values, plain.values);
            INFO(difference.text);
            CHECK(difference.percentile_99_9 <= (has_bf16() ? 5e-4 : 1e-5));
            CHECK(difference.largest <= (has_bf16() ? 1e-3 : 1e-4));
            CHECK(difference.largest > 0);
        }
        CHECK(fixture.applier(Direction::reverse, Precision::fast)->halo() == (has_bf16() ? 4 : 17));
        CHECK(Fixture(1).applier(Direction::reverse, Precision::fast)->halo() == 0);
    });
}

TEST_CASE("every size from 1 × 1 gives the same bits with any number of threads")
{
    on_each_fast_method([&] {
        const Fixture spatial(3), pointwise(1);
        for (const auto& [fixture, precision] : { std::pair(&spatial, Precision::float32),
                                                  { &spatial, Precision::fast },
                                                  { &pointwise, Precision::float32 } }) {
            const auto applier = fixture->applier(Direction::reverse, precision);
            for (const auto& [width, height] :
                 { std::pair(1, 1), std::pair(1, 300), std::pair(1000, 1), std::pair(2, 3), std::pair(9, 9),
                   std::pair(187, 20), std::pair(189, 33), std::pair(401, 270) }) {
                const Image source = random_image(width, height);
                const Image one = applied(*applier, source, 1);
                CHECK(std::all_of(one.values.begin(), one.values.end(), [](float v) { return v >= 0 && v <= 1; }));
                for (const int threads : { 0, 2, 3, 8 }) {
                    INFO(width, " × ", height, ", threads ", threads);
                    CHECK(applied(*applier, source, threads).values == one.values);
                }
            }
        }
    });
}

TEST_CASE("any region of interest, from any part of the image, has the bits of the whole")
{
    on_each_fast_method([&] {
        for (const auto& [kernel_size, precision] :
             { std::pair(3, Precision::float32), std::pair(3, Precision::fast), std::pair(1, Precision::float32),
               std::pair(1, Precision::fast) }) {
            const Fixture fixture(kernel_size);
            const auto applier = fixture.applier(Direction::reverse, precision);
            Image source = random_image(300, 150);
            Image whole = applied(*applier, source);
            Random random(5);
            for (int i = 0; i < 40; ++i) {
                const int x0 = random.below(300), y0 = random.below(150);
                const Roi roi{ x0, x0 + 1 + random.below(300 - x0), y0, y0 + 1 + random.below(150 - y0) };
                const int halo = applier->halo();
                const int sx = std::max(roi.x0 - halo, 0), sy = std::max(roi.y0 - halo, 0);
                const ImageView part{ source.view().pixel(sx, sy), std::min(roi.x1 + halo, 300) - sx,
                                      std::min(roi.y1 + halo, 150) - sy, 3, 900 };
                Image target{ roi.x1 - roi.x0, roi.y1 - roi.y0 };
                REQUIRE(applier->run({ part, sx, sy, 300, 150 }, roi, target.view(), on_threads(1 + i % 3)));
                bool same = true;
                for (int y = 0; y < target.height; ++y)
                    same &= std::equal(target.view().pixel(0, y), target.view().pixel(0, y) + 3 * target.width,
                                       whole.view().pixel(roi.x0, roi.y0 + y));
                INFO("region [", roi.x0, ", ", roi.x1, ") × [", roi.y0, ", ", roi.y1, "), kernel ", kernel_size,
                     ", halo ", halo);
                CHECK(same);
            }
        }
    });
}

TEST_CASE("in place equals a copy, RGBA strides too")
{
    on_each_fast_method([&] {
        const Fixture spatial(3), pointwise(1);
        for (const auto& [fixture, precision] : { std::pair(&spatial, Precision::float32),
                                                  { &spatial, Precision::fast },
                                                  { &pointwise, Precision::float32 } }) {
            const auto applier = fixture->applier(Direction::forward, precision);
            Image source = random_image(230, 1100); // several bands
            const Image expected = applied(*applier, source);
            Image rgba{ 230, 1100, 4 };
            for (int y = 0; y < 1100; ++y)
                for (int x = 0; x < 230; ++x)
                    std::copy_n(source.view().pixel(x, y), 3, rgba.view().pixel(x, y));
            for (const int threads : { 1, 3 }) {
                Image in_place = source;
                REQUIRE(applier->run(in_place.view(), in_place.view(), on_threads(threads)));
                CHECK(in_place.values == expected.values);
            }
            REQUIRE(applier->run(rgba.view(), rgba.view()));
            bool same = true;
            for (int y = 0; y < 1100; ++y)
                for (int x = 0; x < 230; ++x)
                    for (int c = 0; c < 3; ++c)
                        same &= rgba.view().pixel(x, y)[c] == expected.values[(std::size_t(y) * 230 + x) * 3 + c];
            CHECK(same);
        }
    });
}

TEST_CASE("the pointwise tone map equals a plain one in double")
{
    Fixture fixture(1);
    fixture.parameters.color = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    fixture.parameters.gamma = fixture.parameters.gain = 1;
    fixture.parameters.white_balance = { 1, 1, 1 };
    const Image source = random_image(7, 27);
    const std::vector<double> expected = tone_mapped(fixture, source, random_model(1, 1));
    on_each_instruction_set([&] {
        const Difference difference = compare(applied(*fixture.applier(), source).values, expected);
        INFO(difference.text);
        CHECK(difference.largest <= 1e-5);
    });
}

TEST_CASE("fast of a pointwise model is near float32 where an image is worth a table, and float32 where it is not")
{
    const Fixture fixture(1);
    for (const Direction direction : { Direction::reverse, Direction::forward }) {
        const auto plain = fixture.applier(direction), fast = fixture.applier(direction, Precision::fast);
        const Image small = random_image(260, 260), large = random_image(300, 310);
        CHECK(applied(*fast, small).values == applied(*plain, small).values);
        const Image by_table = applied(*fast, large);
        const Difference difference = compare(by_table.values, applied(*plain, large).values);
        INFO(difference.text);
        CHECK(difference.percentile_99_9 <= 5e-4);
        CHECK(difference.largest <= 2e-3);
        CHECK(difference.largest > 0);
        for (const int threads : { 2, 3, 8 })
            CHECK(applied(*fast, large, threads).values == by_table.values);
        // A part has the bits of the whole, however few pixels it has.
        Image source = large, target{ 5, 3 };
        REQUIRE(fixture.applier(direction, Precision::fast)
                    ->run({ source.view(), 0, 0, 300, 310 }, { 100, 105, 50, 53 }, target.view()));
        bool same = true;
        for (int y = 0; y < 3; ++y)
            same &= std::equal(target.values.begin() + 15 * y, target.values.begin() + 15 * (y + 1),
                               by_table.values.begin() + 3 * (300 * (50 + y) + 100));
        CHECK(same);
    }
}

TEST_CASE("a pointwise model works on rows with gaps, on pixels with gaps, and where other pixels become its target")
{
    const Fixture fixture(1);
    const auto applier = fixture.applier();
    const Image source = random_image(100, 90), expected = applied(*applier, source);
    for (const int channels : { 3, 4 })
        for (const int gap : { 0, 7 })
            for (const int threads : { 1, 3 }) {
                INFO(channels, " channels, ", gap, " floats between rows, threads ", threads);
                const std::ptrdiff_t y_stride = channels * 100 + gap;
                std::vector<float> memory(y_stride * 90, -3.0f);
                const MutableImageView view{ memory.data(), 100, 90, channels, y_stride };
                for (int y = 0; y < 90; ++y)
                    for (int x = 0; x < 100; ++x)
                        std::copy_n(&source.values[3 * (100 * y + x)], 3, view.pixel(x, y));
                REQUIRE(applier->run(view, view, on_threads(threads)));
                bool same = true;
                for (int y = 0; y < 90; ++y) {
                    for (int x = 0; x < 100; ++x) {
                        same &= std::equal(view.pixel(x, y), view.pixel(x, y) + 3, &expected.values[3 * (100 * y + x)]);
                        same &= channels == 3 || view.pixel(x, y)[3] == -3.0f;
                    }
                    same &= gap == 0 || view.pixel(100, y)[0] == -3.0f;
                }
                CHECK(same);
            }
    Image moved = source; // rows 40 and below to the top
    MutableImageView top = moved.view();
    top.height = 50;
    REQUIRE(applier->run({ moved.view(), 0, 0, 100, 90 }, { 0, 100, 40, 90 }, top, on_threads(2)));
    CHECK(
        std::equal(moved.values.begin(), moved.values.begin() + 3 * 100 * 50, expected.values.begin() + 3 * 100 * 40));
}

TEST_CASE("progress grows to its end on the caller's thread, and false cancels")
{
    for (const int kernel_size : { 3, 1 }) {
        const Fixture fixture(kernel_size);
        Image source = random_image(400, 400), target{ 400, 400 };
        ApplyOptions options = on_threads(1);
        std::vector<float> reported;
        options.progress = [&](float part) {
            reported.push_back(part);
            return true;
        };
        REQUIRE(fixture.applier()->run(source.view(), target.view(), options));
        CHECK(reported.size() > 3);
        CHECK(std::is_sorted(reported.begin(), reported.end()));
        CHECK(reported.back() == 1.0f);
        options.progress = [](float) { return false; };
        const Status status = fixture.applier()->run(source.view(), target.view(), options);
        REQUIRE(!status);
        CHECK(status.error().message == "apply: cancelled");
    }
}

TEST_CASE("regions, targets and sources that do not fit are refused with their numbers")
{
    const Fixture fixture;
    const auto applier = fixture.applier();
    Image source = random_image(20, 20), target{ 10, 10 };
    Status status = applier->run(source.view(), target.view());
    REQUIRE(!status);
    CHECK(status.error().message == "apply: target is 10 × 10, region is 20 × 20");
    status = applier->run({ source.view(), 0, 0, 20, 20 }, { 15, 25, 0, 10 }, target.view());
    REQUIRE(!status);
    CHECK(status.error().message == "apply: region [15, 25) × [0, 10) is empty or outside the image of 20 × 20");
    status = applier->run({ source.view(), 10, 10, 40, 40 }, { 12, 22, 14, 24 }, target.view());
    REQUIRE(!status);
    CHECK(status.error().message ==
          "apply: source of 20 × 20 at (10, 10) does not hold the region and 4 pixels around it");
}

TEST_CASE("parameters of another model, or with a singular matrix, are refused")
{
    Fixture fixture;
    fixture.parameters.color = { 1, 2, 3, 2, 4, 6, 1, 1, 1 };
    Expected<std::shared_ptr<const Applier>> applier =
        Applier::create(*fixture.model, fixture.parameters, Direction::reverse);
    REQUIRE(!applier);
    CHECK(applier.error().message.find("'color' is singular") != std::string::npos);
    fixture.parameters.model_hash = "xxh128:0";
    applier = Applier::create(*fixture.model, fixture.parameters, Direction::reverse);
    REQUIRE(!applier);
    CHECK(applier.error().message.find("parameters were chosen with model") != std::string::npos);
}
