// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include <doctest/doctest.h>
#include <srisp/mosaic.h>

using namespace srisp;

namespace {

constexpr float kUntouched = -1;

/// An image whose values say where they lie and of which channel they are, with `pixel` floats for each pixel and some
/// more for each row.
struct Numbered {
    int width, height, pixel;
    std::vector<float> values;

    Numbered(int w, int h, int p) : width(w), height(h), pixel(p), values(std::size_t(h) * stride(), kUntouched)
    {
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                for (int c = 0; c < 3; ++c)
                    values[std::size_t(y) * stride() + std::size_t(x * p + c)] = number(x, y, c);
    }
    std::size_t stride() const { return std::size_t(width * pixel + 5); }
    ImageView view() const { return { values.data(), width, height, pixel, std::ptrdiff_t(stride()) }; }
    static float number(int x, int y, int c) { return float(c + 10 * x + 10000 * y); }
};

} // namespace

TEST_CASE("a mosaic holds of each pixel the channel of its filter, for any size, stride, phase and offset")
{
    for (const auto& [width, height] : { std::pair{ 1, 1 }, { 2, 2 }, { 1, 6 }, { 7, 1 }, { 8, 5 }, { 33, 70 } })
        for (const int pixel : { 3, 4 })
            for (const int x_stride : { 1, 2 })
                for (const int phase : { 0, 1, 2, 3 })
                    for (const int offset : { 0, 1, 3, -1 }) {
                        const Numbered image(width, height, pixel);
                        const MosaicPlace place{ BayerPhase(phase), offset, 2 * offset + 1 };
                        std::vector<float> plane(std::size_t(height * (width * x_stride + 3)), kUntouched);
                        const std::ptrdiff_t row = width * x_stride + 3;
                        const Status made =
                            make_mosaic(image.view(), place, { plane.data(), width, height, x_stride, row });
                        REQUIRE(made);
                        std::size_t wrong = 0, touched = 0;
                        for (int y = 0; y < height; ++y)
                            for (int x = 0; x < width; ++x) {
                                const int color = bayer_color(place.phase, place.x + x, place.y + y);
                                wrong += plane[std::size_t(y * row + x * x_stride)] != Numbered::number(x, y, color);
                            }
                        for (const float value : plane)
                            touched += value != kUntouched;
                        CHECK(wrong == 0);
                        CHECK(touched == std::size_t(width * height));
                    }
}

TEST_CASE("pieces of a mosaic fit together, and threads change nothing")
{
    const Numbered image(50, 131, 3);
    std::vector<float> whole(50 * 131), pieces(50 * 131);
    REQUIRE(make_mosaic(image.view(), { BayerPhase::gbrg, 0, 0 }, { whole.data(), 50, 131, 1, 50 }, 1));
    for (const auto& [x0, x1] : { std::pair{ 0, 17 }, { 17, 50 } })
        for (const auto& [y0, y1] : { std::pair{ 0, 3 }, { 3, 131 } }) {
            ImageView from = image.view();
            from = { from.pixel(x0, y0), x1 - x0, y1 - y0, from.x_stride, from.y_stride };
            REQUIRE(make_mosaic(from, { BayerPhase::gbrg, x0, y0 },
                                { pieces.data() + y0 * 50 + x0, x1 - x0, y1 - y0, 1, 50 }, 3));
        }
    CHECK(pieces == whole);
}

TEST_CASE("a mosaic of another size than its image is refused")
{
    const Numbered image(4, 3, 3);
    std::vector<float> plane(12);
    const Status made = make_mosaic(image.view(), {}, { plane.data(), 3, 4, 1, 3 });
    CHECK(made.error().message == "a mosaic of 3 x 4 pixels cannot be made of 4 x 3");
}
