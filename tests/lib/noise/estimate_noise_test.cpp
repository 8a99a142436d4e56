// SPDX-License-Identifier: Apache-2.0
#include "noise/estimate_noise.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "noise/flat_blocks.h"
#include "reference/decoders.h"
#include "shared_files.h"

using namespace srisp;

namespace {

/// A mosaic that was made: 14 bits over a black level of 512, or floats.
struct MadeRaw {
    std::vector<float> values;
    std::vector<std::uint16_t> shorts;
    RawPixels pixels;

    /// `scene(x, y)`: in [0,1] without noise.
    template<class Scene> MadeRaw(int width, int height, const NoiseModel& noise, Scene scene)
    {
        constexpr float kBlack = 512, kWhite = 16383;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                values.push_back(float(scene(x, y)));
        REQUIRE(add_noise({ values.data(), width, height, 1, width }, { BayerPhase::grbg, 0, 0 }, noise, 11));
        for (const float value : values)
            shorts.push_back(
                std::uint16_t(std::lround(std::min(std::max(kBlack + value * (kWhite - kBlack), 0.0f), kWhite))));
        pixels.shorts = shorts.data();
        pixels.row_stride = width;
        pixels.width = width;
        pixels.height = height;
        pixels.cfa = { 2, 2, "GRBG" };
        pixels.black = { 1, 1, { kBlack }, {}, {} };
        pixels.white = { kWhite, kWhite, kWhite };
    }
};

/// Slopes, waves, and on a third of the picture a fine texture much stronger than noise.
double busy_scene(int x, int y)
{
    const double slope = 0.001 + 0.85 * std::pow(double(x) / 2048, 2);
    const bool rough = (x / 128 + y / 128) % 3 == 0;
    const double wave = 0.05 * slope * std::sin(0.013 * y);
    return slope + wave + (rough ? 0.3 * slope * std::sin(1.7 * x) * std::cos(1.3 * y + 0.4 * x) : 0);
}

RawImage camera_file(const std::string& name)
{
    const auto file = read_whole_file(shared_file("data/raw/" + name));
    REQUIRE(file);
    const auto raw = decode_raw(*file);
    REQUIRE_MESSAGE(raw, (raw ? "" : raw.error().message));
    return *raw;
}

/// A camera's mosaic in [0,1] with more noise than it had.
struct NoisierRaw {
    std::vector<float> values;
    RawPixels pixels;

    NoisierRaw(const RawPixels& raw, const NoiseModel& noise) : pixels(raw)
    {
        for (int y = 0; y < raw.height; ++y)
            for (int x = 0; x < raw.width; ++x) {
                const float black = raw.black.at(y, x);
                values.push_back((float(raw.shorts[y * raw.row_stride + x]) - black) / (raw.white[0] - black));
            }
        const auto phase = parse_bayer_phase(raw.cfa.letters);
        REQUIRE(phase);
        REQUIRE(add_noise({ values.data(), raw.width, raw.height, 1, raw.width }, { *phase, 0, 0 }, noise, 3));
        pixels.shorts = nullptr;
        pixels.floats = values.data();
        pixels.row_stride = raw.width;
        pixels.black = { 1, 1, { 0 }, {}, {} };
        pixels.white = { 1, 1, 1 };
    }
};

std::string refusal(const RawPixels& pixels)
{
    const auto noise = estimate_noise(pixels);
    return noise ? "(it was estimated)" : noise.error().message;
}

} // namespace

TEST_CASE("noise is estimated from a picture with slopes and texture to within 10 %")
{
    for (const auto& [shot, read] : { std::pair{ 2e-4, 1e-6 }, { 1e-3, 2e-5 }, { 5e-3, 2e-4 } }) {
        const NoiseModel noise{ { shot, 0.9 * shot, 1.2 * shot }, { read, 1.5 * read, 0.8 * read } };
        const MadeRaw raw(2048, 1536, noise, busy_scene);
        const auto estimated = estimate_noise(raw.pixels);
        REQUIRE_MESSAGE(estimated, (estimated ? "" : estimated.error().message));
        for (std::size_t c = 0; c < 3; ++c) {
            INFO("shot ", shot, ", read ", read, ", colour ", c);
            CHECK(estimated->shot[c] == doctest::Approx(noise.shot[c]).epsilon(0.1));
            CHECK(estimated->read[c] == doctest::Approx(noise.read[c]).epsilon(0.1));
        }
    }
}

TEST_CASE("where half of a picture is textured as finely as noise is, shot noise is estimated to within 10 %")
{
    const auto patches = [](int x, int y) {
        const double level = std::fmod((x / 200 * 37 + y / 150 * 91) * 0.6180339, 1.0);
        const bool rough = (x / 200 + y / 150) % 2;
        return 0.002 + 0.8 * level * level + (rough ? 0.1 * level * std::sin(0.9 * x) * std::sin(1.1 * y) : 0);
    };
    for (const auto& [shot, read] : { std::pair{ 2e-4, 1e-6 }, { 1e-3, 2e-5 }, { 5e-3, 2e-4 } }) {
        const NoiseModel noise{ { shot, shot, shot }, { read, read, read } };
        const auto estimated = estimate_noise(MadeRaw(2048, 1536, noise, patches).pixels);
        REQUIRE_MESSAGE(estimated, (estimated ? "" : estimated.error().message));
        for (std::size_t c = 0; c < 3; ++c) {
            INFO("shot ", shot, ", read ", read, ", colour ", c);
            CHECK(estimated->shot[c] == doctest::Approx(shot).epsilon(0.1));
            CHECK(estimated->read[c] == doctest::Approx(read).epsilon(0.3));
        }
    }
}

TEST_CASE("an estimate is the same for any number of threads, and black levels of rows and columns do not count")
{
    const NoiseModel noise{ { 1e-3, 1e-3, 1e-3 }, { 2e-5, 2e-5, 2e-5 } };
    MadeRaw raw(2048, 1024, noise, busy_scene);
    const auto one = estimate_noise(raw.pixels, 1), three = estimate_noise(raw.pixels, 3);
    REQUIRE(one);
    REQUIRE(three);
    CHECK(one->shot == three->shot);
    CHECK(one->read == three->read);
    for (int x = 0; x < 2048; ++x)
        raw.pixels.black.by_column.push_back(float(x % 7));
    for (int y = 0; y < 1024; ++y)
        raw.pixels.black.by_row.push_back(float(y % 5));
    for (std::size_t i = 0; i < raw.shorts.size(); ++i)
        raw.shorts[i] = std::uint16_t(raw.shorts[i] + i % 2048 % 7 + i / 2048 % 5);
    const auto shifted = estimate_noise(raw.pixels);
    REQUIRE(shifted);
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(shifted->shot[c] == doctest::Approx(one->shot[c]).epsilon(0.03));
}

TEST_CASE("floats far below black, which no sensor makes, do not spoil the estimate from the rest of a picture")
{
    const NoiseModel noise{ { 1e-3, 1e-3, 1e-3 }, { 2e-5, 2e-5, 2e-5 } };
    MadeRaw raw(2048, 1536, noise, busy_scene);
    raw.pixels.shorts = nullptr;
    raw.pixels.floats = raw.values.data();
    raw.pixels.black = { 1, 1, { 0 }, {}, {} };
    raw.pixels.white = { 1, 1, 1 };
    for (int y = 0; y < 512; ++y)
        for (int x = 0; x < 512; ++x)
            raw.values[std::size_t(y * 2048 + x)] = (x / 2 + y / 2) % 2 ? -3e19f : 0.0f;
    const auto estimated = estimate_noise(raw.pixels);
    REQUIRE_MESSAGE(estimated, (estimated ? "" : estimated.error().message));
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(estimated->shot[c] == doctest::Approx(1e-3).epsilon(0.1));
}

TEST_CASE("pictures that do not show their noise are refused with the reason")
{
    const NoiseModel noise{ { 1e-3, 1e-3, 1e-3 }, { 2e-5, 2e-5, 2e-5 } };
    CHECK(refusal(MadeRaw(1024, 768, noise, [](int, int) { return 0.2; }).pixels).find("R: too few flat blocks (") ==
          0);
    CHECK(refusal(MadeRaw(128, 96, noise, busy_scene).pixels).find("R: too few") == 0);
    CHECK(refusal(MadeRaw(1024, 768, noise, [](int x, int) { return 0.3 + 0.2 * x / 1024; }).pixels)
              .find("R: too small a range of brightness (0.3") == 0);
    const NoiseModel none{};
    CHECK(refusal(MadeRaw(1024, 768, none, busy_scene).pixels).find("R: ") == 0);
    MadeRaw linear(64, 64, noise, busy_scene);
    linear.pixels.channels = 3;
    CHECK(refusal(linear.pixels) == "three channels: demosaicing has mixed the noise of neighbours");
}

TEST_CASE("noise that was added to cameras' pictures is estimated to within 10 %, with what they had before")
{
    SKIP_WITHOUT_SHARED("data/raw/gopro_hero6.dng");
    for (const std::string name : { "canon_kiss_x4.dng", "canon_powershot_g2.crw", "gopro_hero6.dng" }) {
        const RawImage raw = camera_file(name);
        const auto own = estimate_noise(raw.pixels);
        REQUIRE_MESSAGE(own, (own ? "" : own.error().message));
        for (const auto& [shot, read] : { std::pair{ 1e-3, 2e-5 }, { 5e-3, 2e-4 } }) {
            CAPTURE(name);
            CAPTURE(shot);
            const NoisierRaw noisier(raw.pixels, { { shot, shot, shot }, { read, read, read } });
            const auto estimated = estimate_noise(noisier.pixels);
            REQUIRE_MESSAGE(estimated, (estimated ? "" : estimated.error().message));
            for (std::size_t c = 0; c < 3; ++c) {
                CHECK(estimated->shot[c] == doctest::Approx(shot + own->shot[c]).epsilon(0.1));
                CHECK(estimated->read[c] == doctest::Approx(read + own->read[c]).epsilon(0.1));
            }
        }
    }
}

// The profile is the camera's model; of blue it is half of what the file's pixels show.
TEST_CASE("the blocks of a phone's dark frame hold white noise, of its profile's read noise in red and green")
{
    SKIP_WITHOUT_SHARED("data/raw/google_pixel7_dark.dng");
    const RawImage raw = camera_file("google_pixel7_dark.dng");
    const auto profile = profile_noise(raw.facts);
    REQUIRE(profile);
    const auto blocks = block_statistics(raw.pixels, 0);
    for (const std::size_t c : { 0, 1, 2 }) {
        double variance = 0, texture = 0;
        for (const BlockStatistics& block : blocks[c]) {
            variance += double(block.variance) / double(blocks[c].size());
            texture += double(block.texture) / double(blocks[c].size());
        }
        CAPTURE(c);
        CHECK(texture / variance == doctest::Approx(1.0 / 16).epsilon(0.15));
        CHECK(variance / profile->read[c] > 0.9);
        CHECK(variance / profile->read[c] < (c == 2 ? 2.2 : 1.4));
    }
}

// The HERO6 compresses its RAW files with loss, which takes noise away: green measures 0.66 of its profile's shot
// noise, red and blue less.
TEST_CASE("noise estimated from a camera's file is below the file's own profile, as lossy compression leaves it")
{
    SKIP_WITHOUT_SHARED("data/raw/gopro_hero6.dng");
    const RawImage raw = camera_file("gopro_hero6.dng");
    const auto profile = profile_noise(raw.facts), estimated = estimate_noise(raw.pixels);
    REQUIRE(profile);
    REQUIRE(estimated);
    CHECK(estimated->shot[1] / profile->shot[1] == doctest::Approx(0.66).epsilon(0.1));
    for (const std::size_t c : { 0, 2 })
        CHECK(estimated->shot[c] < profile->shot[c]);
}

TEST_CASE("three colours of a camera with one gain are estimated alike, and a dark frame is refused")
{
    SKIP_WITHOUT_SHARED("data/raw/canon_kiss_x4.dng");
    const auto canon = estimate_noise(camera_file("canon_kiss_x4.dng").pixels);
    REQUIRE(canon);
    for (const std::size_t c : { 0, 2 }) {
        CHECK(canon->shot[c] == doctest::Approx(canon->shot[1]).epsilon(0.05));
        CHECK(canon->read[c] == doctest::Approx(canon->read[1]).epsilon(0.2));
    }
    const auto dark = estimate_noise(camera_file("google_pixel7_dark.dng").pixels);
    REQUIRE(!dark);
    CHECK(dark.error().message.find("R: too few flat blocks (1 of 32") == 0);
}
