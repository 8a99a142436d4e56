// SPDX-License-Identifier: Apache-2.0
#include "select/planar_thumbnail.h"

#include <cmath>

#include <doctest/doctest.h>

#include "random_model.h"

using namespace srisp;

namespace {

Thumbnail random_thumbnail()
{
    Thumbnail thumbnail;
    Random random(8);
    for (float& value : thumbnail.rgb)
        value = random.uniform(0, 1);
    return thumbnail;
}

} // namespace

TEST_CASE("thumbnails are reduced to the means of their pixels, and stay as they are at their own size")
{
    const Thumbnail thumbnail = random_thumbnail();
    for (const int size : { 64, 128, kThumbnailSize }) {
        const PlanarThumbnail reduced(thumbnail, size);
        const int side = kThumbnailSize / size;
        double error = 0;
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    double sum = 0;
                    for (int i = 0; i < side * side; ++i)
                        sum += thumbnail.rgb[((y * side + i / side) * kThumbnailSize + x * side + i % side) * 3 + c];
                    error = std::max(error, std::fabs(reduced.planes().plane(c)[y * size + x] - sum / (side * side)));
                }
        INFO("size ", size);
        CHECK(error < 2e-7);
    }
}

TEST_CASE("reduced to a size that cuts pixels, a thumbnail of one colour stays of that colour")
{
    Thumbnail thumbnail;
    for (std::size_t i = 0; i < thumbnail.rgb.size(); ++i)
        thumbnail.rgb[i] = 0.25f * static_cast<float>(1 + i % 3);
    const PlanarThumbnail reduced(thumbnail, 96);
    for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < reduced.count(); ++i)
            CHECK(reduced.planes().plane(c)[i] == doctest::Approx(0.25 * (1 + c)).epsilon(1e-6));
}

TEST_CASE("encoders see displayed images less 0.4, and linear ones as powers of 1 / 2.2 less 0.3 or as they are")
{
    const Thumbnail thumbnail = random_thumbnail();
    const PlanarThumbnail image(thumbnail, 64);
    const auto first = [](EncoderInput input) { return double(input.row(0)[0]); };
    const double value = image.planes().plane(0)[0];
    CHECK(first(display_input(image, true)) == doctest::Approx(value - 0.4).epsilon(1e-6));
    CHECK(first(display_input(image, false)) == value);
    CHECK(first(linear_input(image, true)) == doctest::Approx(std::pow(value, 1 / 2.2) - 0.3).epsilon(1e-5));
    CHECK(first(linear_input(image, false)) == doctest::Approx(value).epsilon(1e-6));
}
