// SPDX-License-Identifier: Apache-2.0
#include "reference/raw_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

using namespace srisp;

namespace {

/// A mosaic of noise with the given pattern; black 100.25 … and white 60000.
struct NoiseMosaic {
    NoiseMosaic(int width, int height, int period, const std::string& letters)
        : samples(std::size_t(width) * std::size_t(height))
    {
        std::mt19937 random(unsigned(width * 31 + height));
        for (auto& sample : samples)
            sample = std::uint16_t(random() >> 16);
        pixels.shorts = samples.data();
        pixels.row_stride = width;
        pixels.width = width;
        pixels.height = height;
        pixels.cfa = { period, period, letters };
        pixels.black.rows = 1;
        pixels.black.columns = 2;
        pixels.black.pattern = { 100.25f, 300 };
        pixels.white.fill(60000);
    }

    double value(int x, int y) const
    {
        const double black = double(pixels.black.pattern[std::size_t(x % 2)]);
        return std::clamp(
            (samples[std::size_t(y) * std::size_t(pixels.width) + std::size_t(x)] - black) / (60000 - black), 0.0, 1.0);
    }

    std::vector<std::uint16_t> samples;
    RawPixels pixels;
};

/// How much of pixel `i` of `count` lies in cell `cell` of 256.
double overlap(int i, int count, int cell)
{
    const double scale = count / 256.0;
    return std::max(0.0, std::min(i + 1.0, (cell + 1) * scale) - std::max(double(i), cell * scale));
}

/// method.md, word by word and slowly: per colour the area average over that colour's own sites.
double brute_force(const NoiseMosaic& mosaic, int cell_x, int cell_y, int color)
{
    double sum = 0, area = 0;
    for (int y = 0; y < mosaic.pixels.height; ++y)
        for (int x = 0; x < mosaic.pixels.width; ++x)
            if (mosaic.pixels.cfa.color(y, x) == color) {
                const double part = overlap(x, mosaic.pixels.width, cell_x) * overlap(y, mosaic.pixels.height, cell_y);
                sum += part * mosaic.value(x, y);
                area += part;
            }
    return sum / area;
}

/// Bilinear by its usual description: the mean of the nearest neighbours of that colour, two or four, as far as they
/// exist.
double demosaiced(const NoiseMosaic& mosaic, int x, int y, int color)
{
    const CfaPattern& cfa = mosaic.pixels.cfa;
    if (cfa.color(y, x) == color)
        return mosaic.value(x, y);
    static const std::vector<std::vector<std::array<int, 2>>> kNeighbours = {
        { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } }, { { -1, -1 }, { 1, -1 }, { -1, 1 }, { 1, 1 } }
    };
    for (const auto& ring : kNeighbours) { // sides first: where they hold the colour, corners do not count
        double sum = 0;
        int count = 0;
        for (const auto& [dx, dy] : ring)
            if (x + dx >= 0 && y + dy >= 0 && x + dx < mosaic.pixels.width && y + dy < mosaic.pixels.height &&
                cfa.color(y + dy, x + dx) == color) {
                sum += mosaic.value(x + dx, y + dy);
                ++count;
            }
        if (count > 0)
            return sum / count;
    }
    return NAN;
}

const std::string kXTrans = "GBGGRGRGRBGBGBGGRGGRGGBGBGBRGRGRGGBG";

} // namespace

TEST_CASE("The thumbnail of a mosaic is the area average over each colour's own sites")
{
    struct {
        int width, height, period;
        std::string letters;
    } const shapes[] = {
        { 512, 512, 2, "RGGB" }, { 1023, 517, 2, "GBRG" }, { 640, 777, 2, "BGGR" }, { 801, 769, 6, kXTrans }
    };
    for (const auto& shape : shapes) {
        CAPTURE(shape.width);
        const NoiseMosaic mosaic(shape.width, shape.height, shape.period, shape.letters);
        REQUIRE(check_filters(mosaic.pixels));
        const Thumbnail thumbnail = raw_thumbnail(mosaic.pixels);
        double worst = 0;
        for (int i = 0; i < 24; ++i) { // corners and places between them
            const int x = i < 2 ? i * 255 : i * 53 % 256, y = i < 4 ? i / 2 * 255 : i * 97 % 256;
            for (int c = 0; c < 3; ++c)
                worst =
                    std::max(worst, std::abs(double(thumbnail.view().pixel(x, y)[c]) - brute_force(mosaic, x, y, c)));
        }
        CHECK(worst < 5e-7);
    }
}

TEST_CASE("Sensors under 512 px are demosaiced bilinearly before they are averaged")
{
    for (const auto& [width, height] : { std::pair(511, 40), std::pair(40, 900), std::pair(2, 2), std::pair(22, 31) }) {
        CAPTURE(width);
        const NoiseMosaic mosaic(width, height, 2, "GRBG");
        const Thumbnail thumbnail = raw_thumbnail(mosaic.pixels);
        double worst = 0;
        for (int cell_y = 0; cell_y < 256; cell_y += 17)
            for (int cell_x = 0; cell_x < 256; cell_x += 15)
                for (int c = 0; c < 3; ++c) {
                    double sum = 0, area = 0;
                    for (int y = 0; y < height; ++y)
                        for (int x = 0; x < width; ++x)
                            if (const double part = overlap(x, width, cell_x) * overlap(y, height, cell_y); part > 0) {
                                sum += part * demosaiced(mosaic, x, y, c);
                                area += part;
                            }
                    worst = std::max(worst, std::abs(double(thumbnail.view().pixel(cell_x, cell_y)[c]) - sum / area));
                }
        CHECK(worst < 5e-7);
    }
}

TEST_CASE("The thumbnail has the same bits for any number of threads")
{
    const NoiseMosaic mosaic(1300, 700, 2, "RGGB");
    int threads = 0;
    OIIO::getattribute("threads", threads);
    OIIO::attribute("threads", 1);
    const Thumbnail alone = raw_thumbnail(mosaic.pixels);
    OIIO::attribute("threads", 4);
    const Thumbnail together = raw_thumbnail(mosaic.pixels);
    OIIO::attribute("threads", threads);
    CHECK(alone.rgb == together.rgb);
}

TEST_CASE("X-Trans sensors too small for their pattern are told")
{
    const NoiseMosaic mosaic(767, 1000, 6, kXTrans);
    CHECK(check_filters(mosaic.pixels).error().message ==
          "sensor of 767 x 1000 pixels: at least 768 a side are needed for its filters");
}
