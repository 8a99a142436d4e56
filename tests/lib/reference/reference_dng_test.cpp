// SPDX-License-Identifier: Apache-2.0
// DNGs made here, one property each, against values that follow from how they were made.
#include <srisp/reference.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <tiffio.h>

#include "lib/reference/loaded_dng.h"
#include "shared_files.h"

using namespace srisp;

namespace {

using T = SyntheticDng;

void check_every_pixel(const Thumbnail& thumbnail, const std::array<double, 3>& expected, double tolerance = 2e-5)
{
    double worst = 0;
    for (std::size_t i = 0; i < thumbnail.rgb.size(); ++i)
        worst = std::max(worst, std::abs(double(thumbnail.rgb[i]) - expected[i % 3]));
    CHECK(worst <= tolerance);
}

/// Means of the channels, to half of the last of three digits.
void check_means(const Thumbnail& thumbnail, const std::array<double, 3>& expected)
{
    std::array<double, 3> sums{};
    for (std::size_t i = 0; i < thumbnail.rgb.size(); ++i)
        sums[i % 3] += double(thumbnail.rgb[i]);
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(std::abs(sums[c] * 3 / double(thumbnail.rgb.size()) - expected[c]) < 6e-4);
}

constexpr double kColors[] = { 0.5, 0.25, 0.75 }; // of R, G, B

/// A value of each site's colour, for the pattern as it is at (left, top).
auto colors_of(const std::string& pattern, int left = 0, int top = 0)
{
    return [=](int x, int y, int) {
        const char letter = pattern[std::size_t(((y - top) & 1) * 2 + ((x - left) & 1))];
        return std::round(65535 * kColors[letter == 'R' ? 0 : letter == 'G' ? 1 : 2]);
    };
}

std::vector<double> pattern_tag(const std::string& pattern)
{
    std::vector<double> values;
    for (const char letter : pattern)
        values.push_back(letter == 'R' ? 0 : letter == 'G' ? 1 : 2);
    return values;
}

} // namespace

TEST_CASE("All four Bayer phases give each colour its own sites, small (demosaiced) and large (not)")
{
    for (const std::string pattern : { "RGGB", "GRBG", "GBRG", "BGGR" })
        for (const auto& [width, height] : { std::pair(40, 30), std::pair(523, 517), std::pair(41, 700) }) {
            CAPTURE(pattern);
            CAPTURE(width);
            SyntheticDng dng;
            dng.resize(width, height).set(33422, T::kByte, pattern_tag(pattern)).fill(colors_of(pattern));
            const Reference reference = loaded(dng);
            CHECK(reference.facts.cfa_pattern == pattern);
            check_every_pixel(reference.thumbnail, { 0.5, 0.25, 0.75 });
        }
}

TEST_CASE("X-Trans patterns of 6 x 6 work from 768 px a side")
{
    const std::string letters = "GBGGRGRGRBGBGBGGRGGRGGBGBGBRGRGRGGBG";
    SyntheticDng dng;
    dng.resize(800, 770).set(33421, T::kShort, { 6, 6 }).set(33422, T::kByte, pattern_tag(letters));
    dng.fill([&](int x, int y, int) {
        const char letter = letters[std::size_t(y % 6 * 6 + x % 6)];
        return std::round(65535 * kColors[letter == 'R' ? 0 : letter == 'G' ? 1 : 2]);
    });
    const Reference reference = loaded(dng);
    CHECK(reference.facts.cfa_pattern == letters);
    check_every_pixel(reference.thumbnail, { 0.5, 0.25, 0.75 });

    dng.resize(100, 100);
    CHECK(refusal(dng.bytes()) == "sensor of 100 x 100 pixels: at least 768 a side are needed for its filters");
}

TEST_CASE("Big-endian files read the same")
{
    SyntheticDng little, big;
    big.big_endian = true;
    CHECK(loaded(little.fill(colors_of("RGGB"))).thumbnail.rgb == loaded(big.fill(colors_of("RGGB"))).thumbnail.rgb);
}

TEST_CASE("Black per position, in fractions, and white")
{
    const double black[] = { 64, 100.5, 30.25, 80 };
    SyntheticDng dng;
    dng.resize(512, 512); // one 2 × 2 of the pattern in each cell
    dng.set(50713, T::kShort, { 2, 2 }).set(50714, T::kRational, { black[0], black[1], black[2], black[3] });
    dng.set(50717, T::kShort, { 4000 }).fill([](int, int, int) { return 1000; });
    const Reference reference = loaded(dng);
    CHECK(reference.facts.black_level == std::array<float, 4>{ 64, 100.5f, 80, 30.25f });
    CHECK(reference.facts.white_level == 4000);
    const auto scaled = [&](double b) { return (1000 - b) / (4000 - b); };
    check_every_pixel(reference.thumbnail,
                      { scaled(black[0]), (scaled(black[1]) + scaled(black[2])) / 2, scaled(black[3]) }, 1e-6);
}

TEST_CASE("Equal black levels need no pattern, however many there are")
{
    for (const std::size_t count : { 2, 3, 4, 36 }) {
        CAPTURE(count);
        SyntheticDng mosaic, linear;
        mosaic.set(50714, T::kShort, std::vector<double>(count, 512)).set(50717, T::kShort, { 10512 });
        mosaic.fill([](int, int, int) { return 5512; });
        check_every_pixel(loaded(mosaic).thumbnail, { 0.5, 0.5, 0.5 }, 1e-6);
        CHECK(loaded(mosaic).notes.empty());
        linear.linear().set(50714, T::kShort, std::vector<double>(count, 512)).set(50717, T::kShort, { 10512 });
        linear.fill([](int, int, int) { return 5512; }, 3);
        check_every_pixel(loaded(linear).thumbnail, { 0.5, 0.5, 0.5 }, 1e-6);
    }
}

TEST_CASE("Four black levels that differ are a pattern of 2 x 2 where the DNG states none, which is noted")
{
    SyntheticDng dng;
    dng.resize(512, 512).set(50714, T::kShort, { 64, 100, 30, 80 }).set(50717, T::kShort, { 4000 });
    dng.fill([](int, int, int) { return 1000; });
    const Reference reference = loaded(dng);
    CHECK(reference.facts.black_level == std::array<float, 4>{ 64, 100, 80, 30 });
    CHECK(reference.notes ==
          std::vector<std::string>{ "the DNG states four black levels without a pattern: 2 x 2 was assumed" });
    const auto scaled = [&](double b) { return (1000 - b) / (4000 - b); };
    check_every_pixel(reference.thumbnail, { scaled(64), (scaled(100) + scaled(30)) / 2, scaled(80) }, 1e-6);

    CHECK(refusal(dng.set(50714, T::kShort, { 64, 100, 30 }).bytes()) ==
          "DNG with 3 black levels where its pattern needs 1");
    CHECK(refusal(dng.set(50713, T::kShort, { 1, 1 }).set(50714, T::kShort, { 64, 100, 30, 80 }).bytes()) ==
          "DNG with 4 black levels where its pattern needs 1");
}

TEST_CASE("A small writer's DNG with four equal black levels is what it was made from")
{
    SKIP_WITHOUT_SHARED("cases/dng_four_black_levels_without_repeat_dim.dng");
    const auto reference = load_reference(shared_file("cases/dng_four_black_levels_without_repeat_dim.dng"));
    REQUIRE_MESSAGE(reference, (reference ? "" : reference.error().message));
    check_means((*reference)->thumbnail, { 0.347, 0.403, 0.346 });
}

TEST_CASE("Black levels per column and row, which LibRaw averages, are subtracted where they are")
{
    SyntheticDng dng;
    std::vector<double> h, v;
    for (int x = 0; x < dng.width; ++x)
        h.push_back(3 * x);
    for (int y = 0; y < dng.height; ++y)
        v.push_back(-2 * y);
    dng.set(50714, T::kShort, { 500 }).set(50715, T::kSRational, h).set(50716, T::kSRational, v);
    dng.fill([](int x, int y, int) { return 500 + 3 * x - 2 * y + 6000; });
    const Reference reference = loaded(dng);
    const float low = *std::min_element(reference.thumbnail.rgb.begin(), reference.thumbnail.rgb.end());
    const float high = *std::max_element(reference.thumbnail.rgb.begin(), reference.thumbnail.rgb.end());
    // 6000 above black everywhere; only white − black varies, by ±59 + 117 of 65000.
    CHECK(low > 6000 / 65200.0);
    CHECK(high < 6000 / 64800.0);
}

TEST_CASE("Masked pixels stay out and the pattern starts at the active area, even at odd offsets")
{
    for (const auto& [top, left] : { std::pair(0, 0), std::pair(1, 0), std::pair(2, 3), std::pair(5, 1) }) {
        CAPTURE(top);
        CAPTURE(left);
        SyntheticDng dng;
        const int bottom = dng.height - 1, right = dng.width - 2, l = left, t = top;
        dng.set(50829, T::kLong, { double(top), double(left), double(bottom), double(right) });
        dng.set(33422, T::kByte, pattern_tag("GRBG"));
        const auto inside = colors_of("GRBG", left, top);
        dng.fill(
            [&](int x, int y, int s) { return x < l || y < t || x >= right || y >= bottom ? 65535 : inside(x, y, s); });
        const Reference reference = loaded(dng);
        CHECK(reference.facts.width == right - left);
        CHECK(reference.facts.height == bottom - top);
        CHECK(reference.facts.cfa_pattern == "GRBG");
        check_every_pixel(reference.thumbnail, { 0.5, 0.25, 0.75 });
    }
}

TEST_CASE("Thumbnails are upright: EXIF orientation 6 shows the stored left side on top, 8 at the bottom, 2 mirrored")
{
    SyntheticDng dng;
    dng.fill([](int x, int, int) { return x < 20 ? 60000 : 20000; }); // left half bright
    const auto value = [&](int orientation, int x, int y) {
        return loaded(dng.set(274, T::kShort, { double(orientation) })).thumbnail.view().pixel(x, y)[1] > 0.6f;
    };
    CHECK(value(1, 10, 128));
    CHECK(!value(2, 10, 128));
    CHECK(!value(3, 10, 128));
    CHECK(value(4, 10, 128));
    CHECK(value(6, 128, 10));
    CHECK(!value(6, 128, 245));
    CHECK(!value(8, 128, 10));
    CHECK(value(8, 128, 245));
    CHECK(loaded(dng.set(274, T::kShort, { 99 })).facts.orientation == 1);
}

TEST_CASE("LinearRaw takes levels per channel")
{
    SyntheticDng dng;
    dng.linear().set(50714, T::kShort, { 100, 200, 300 }).set(50717, T::kShort, { 1100, 2200, 4300 });
    const double levels[] = { 600, 700, 3300 };
    dng.fill([&](int, int, int s) { return levels[s]; }, 3);
    const Reference reference = loaded(dng);
    CHECK(reference.facts.cfa_pattern.empty());
    CHECK(reference.facts.black_level == std::array<float, 4>{ 100, 200, 300, 200 });
    check_every_pixel(reference.thumbnail, { 0.5, 0.25, 0.75 }, 1e-6);
}

TEST_CASE("Floating point DNGs work: mosaic and LinearRaw, of 32 bits")
{
    SyntheticDng mosaic, rgb;
    const auto sites = colors_of("RGGB");
    mosaic.erase(50717).fill_float([&](int x, int y, int s) { return float(sites(x, y, s) / 65535); }, 1);
    check_every_pixel(loaded(mosaic).thumbnail, { 0.5, 0.25, 0.75 });
    CHECK(loaded(mosaic).facts.white_level == 1);

    rgb.linear().erase(50717).fill_float([](int, int, int s) { return float(kColors[s]); }, 3);
    check_every_pixel(loaded(rgb).thumbnail, { 0.5, 0.25, 0.75 }, 0);

    rgb.fill_float([](int x, int y, int s) { return x == 7 && y == 11 && s == 2 ? NAN : 0.5f; }, 3);
    CHECK(refusal(rgb.bytes()).find("NaN, infinity or wrong data") != std::string::npos);
    rgb.set(256, T::kLong, { 10000 }).set(257, T::kLong, { 10000 });
    CHECK(refusal(rgb.bytes()) == "floating point DNG of 300000000 values, the limit is 268435456");
}

TEST_CASE("Floating point DNGs work compressed: Deflate with the float predictor, tiles, half floats")
{
    const ScratchFolder folder;
    const std::string path = folder.path("deflate.dng");
    TIFF* tiff = TIFFOpen(path.c_str(), "w");
    const int width = 70, height = 50;
    const std::uint8_t version[] = { 1, 4, 0, 0 };
    for (const auto& [tag, value] :
         { std::pair(TIFFTAG_IMAGEWIDTH, width), std::pair(TIFFTAG_IMAGELENGTH, height),
           std::pair(TIFFTAG_SAMPLESPERPIXEL, 3), std::pair(TIFFTAG_BITSPERSAMPLE, 16),
           std::pair(TIFFTAG_SAMPLEFORMAT, 3), std::pair(TIFFTAG_PHOTOMETRIC, 34892),
           std::pair(TIFFTAG_PLANARCONFIG, 1), std::pair(TIFFTAG_COMPRESSION, 8), std::pair(TIFFTAG_PREDICTOR, 3),
           std::pair(TIFFTAG_TILEWIDTH, 32), std::pair(TIFFTAG_TILELENGTH, 32), std::pair(TIFFTAG_SUBFILETYPE, 0) })
        TIFFSetField(tiff, std::uint32_t(tag), value);
    TIFFSetField(tiff, TIFFTAG_DNGVERSION, version);
    std::vector<std::uint16_t> tile;
    for (int i = 0; i < 32 * 32; ++i)
        tile.insert(tile.end(), { 0x3800, 0x3400, 0x3a00 }); // 0.5, 0.25, 0.75
    for (std::uint32_t i = 0; i < 6; ++i)
        REQUIRE(TIFFWriteEncodedTile(tiff, i, tile.data(), tmsize_t(tile.size() * 2)) > 0);
    TIFFClose(tiff);

    const auto reference = load_reference(path);
    REQUIRE_MESSAGE(reference, (reference ? "" : reference.error().message));
    check_every_pixel((*reference)->thumbnail, { 0.5, 0.25, 0.75 }, 0);
}

TEST_CASE("A linearization table is applied before the levels")
{
    SyntheticDng dng;
    dng.set(50712, T::kShort, { 0, 10000, 20000, 60000 })
        .set(50714, T::kShort, { 10000 })
        .set(50717, T::kShort, { 60000 });
    dng.fill([](int, int, int) { return 2; });
    check_every_pixel(loaded(dng).thumbnail, { 0.2, 0.2, 0.2 }, 1e-6);
}

TEST_CASE("Values are clipped to [0,1]")
{
    SyntheticDng dng;
    dng.set(50714, T::kShort, { 1000 }).set(50717, T::kShort, { 2000 });
    dng.fill([](int x, int, int) { return x % 2 == 0 ? 5 : 5000; });
    const Thumbnail thumbnail = loaded(dng).thumbnail;
    CHECK(*std::min_element(thumbnail.rgb.begin(), thumbnail.rgb.end()) == 0);
    CHECK(*std::max_element(thumbnail.rgb.begin(), thumbnail.rgb.end()) == 1);
}

TEST_CASE("Facts from tags: opcodes noted, matrix with calibration and analog balance, neutral with green 1")
{
    SyntheticDng dng;
    dng.set(51009, T::kByte, { 0, 0, 0, 0 }).set(50721, T::kSRational, { 1, 0, 0, 0, 1, 0, 0, 0, 1 });
    dng.set(50778, T::kShort, { 17 }).set(50723, T::kSRational, { 2, 0, 0, 0, 1, 0, 0, 0, 0.5 });
    dng.set(50727, T::kRational, { 1, 3, 1 }).set(50728, T::kRational, { 0.4, 0.8, 0.6 });
    dng.set(51041, T::kDouble, { 1e-4, 2e-7 }).set(34855, T::kShort, { 400 }).set(33434, T::kRational, { 0.01 });
    const Reference reference = loaded(dng.fill(colors_of("RGGB")));
    REQUIRE(reference.facts.color_matrices.size() == 1);
    CHECK(reference.facts.color_matrices[0].illuminant == 17);
    CHECK(reference.facts.color_matrices[0].xyz_to_camera == std::array<float, 9>{ 2, 0, 0, 0, 3, 0, 0, 0, 0.5f });
    CHECK(reference.facts.as_shot_neutral[0] == doctest::Approx(0.5));
    CHECK(reference.facts.as_shot_neutral[1] == 1);
    CHECK(reference.facts.as_shot_neutral[2] == doctest::Approx(0.75));
    CHECK(reference.facts.noise_profile == std::vector<double>{ 1e-4, 2e-7 });
    CHECK(reference.facts.iso == 400);
    CHECK(reference.facts.exposure_time_s == doctest::Approx(0.01));
    REQUIRE(reference.notes.size() == 2);
    CHECK(reference.notes[0] == "OpcodeList2 of the DNG (gain maps and other corrections) was ignored");
    CHECK(reference.notes[1] == "the DNG states no black level: 0 was assumed");
}

TEST_CASE("What can't be a reference is refused, each with its own message")
{
    const auto with = [](const std::function<void(SyntheticDng&)>& change) {
        SyntheticDng dng;
        dng.fill(colors_of("RGGB"));
        change(dng);
        return refusal(dng.bytes());
    };
    CHECK(with([](T& d) { d.set(256, T::kLong, { 0 }); }) == "DNG of 0 x 30 pixels: the image area is empty");
    CHECK(with([](T& d) { d.set(257, T::kLong, { 2147483648.0 }); }) ==
          "DNG of 40 x 1000000000 pixels, the limit is 65535 a side");
    CHECK(with([](T& d) {
              d.set(50829, T::kLong, { 0, 0, 0, 40 });
          }) == "DNG of 40 x 30 pixels whose active area (top 0, left 0, bottom 0, right 40) is empty or lies outside");
    CHECK(with([](T& d) {
              d.set(50829, T::kLong, { 0, 0, 30, 41 });
          }) ==
          "DNG of 40 x 30 pixels whose active area (top 0, left 0, bottom 30, right 41) is empty or lies outside");
    CHECK(with([](T& d) { d.set(262, T::kShort, { 34892 }); }) ==
          "monochrome DNG (LinearRaw with one sample per pixel): a reference needs three colours");
    CHECK(with([](T& d) { d.set(262, T::kShort, { 34892 }).set(277, T::kShort, { 4 }); }) ==
          "LinearRaw DNG with 4 samples per pixel: a reference needs three colours");
    CHECK(with([](T& d) {
              d.set(33422, T::kByte, { 4, 5, 3, 1 });
          }) == "filters of colours other than R, G, B (MYCG): not supported");
    CHECK(with([](T& d) {
              d.set(33422, T::kByte, { 0, 1, 1, 0 });
          }) == "filters without one for each of R, G, B (RGGR): not supported");
    CHECK(with([](T& d) {
              d.set(33421, T::kShort, { 2, 4 }).set(33422, T::kByte, std::vector<double>(8, 1));
          }) == "DNG mosaic of 8 filters: only patterns of 2 x 2 and 6 x 6 are supported");
    CHECK(with([](T& d) { d.set(50711, T::kShort, { 2 }); }) ==
          "DNG with a staggered mosaic (CFALayout 2): not supported");
    CHECK(with([](T& d) { d.set(50714, T::kShort, { 500 }).set(50717, T::kShort, { 500 }); }) ==
          "black level 500 is not below white level 500");
    CHECK(with([](T& d) { d.set(50714, T::kFloat, { NAN }); }) == "a black level is not a finite number");
    CHECK(with([](T& d) {
              d.set(50713, T::kShort, { 2, 2 }).set(50714, T::kShort, { 1, 2, 3 });
          }) == "DNG with 3 black levels where its pattern needs 4");
    CHECK(with([](T& d) {
              d.set(50715, T::kSRational, { 1, 2 });
          }) == "DNG whose BlackLevelDeltaH (2) or BlackLevelDeltaV (0) does not fit its active area");
    CHECK(with([](T& d) { d.set(262, T::kShort, { 2 }); }) ==
          "DNG without a main RAW image (photometric interpretation CFA or LinearRaw)");
    CHECK(with([](T& d) { d.set(259, T::kShort, { 34892 }); }) ==
          "damaged lossy DNG: its image data do not begin with a JPEG");
    CHECK(with([](T& d) { d.set(259, T::kShort, { 9 }); }).find("is a GoPro RAW file (GPR), compressed by VC-5") == 0);
    CHECK(with([](T& d) { d.set(259, T::kShort, { 8 }); }) ==
          "DNG of integers with compression 8: LibRaw does not decode it");
    CHECK(with([](T& d) { d.fill([](int, int, int) { return 100; }); }) ==
          "is a black frame: 98 % of its values are at or below 0.00153, the limit is 0.005");
    CHECK(with([](T& d) { d.resize(20, 20); }).find("is not a RAW file that LibRaw") ==
          0); // it takes nothing under 22 px
}

TEST_CASE("Truncated DNGs are errors at every length")
{
    SyntheticDng dng;
    const std::string whole = dng.fill(colors_of("RGGB")).bytes();
    CHECK(refusal(whole.substr(0, whole.size() - 1)) == "truncated: image data end at byte " +
                                                            std::to_string(whole.size()) + ", the file has " +
                                                            std::to_string(whole.size() - 1));
    for (std::size_t length = 0; length < whole.size(); length += length < 200 ? 1 : 97)
        CHECK(!load(whole.substr(0, length)));
    // Sizes that lie: the data would fill 4 GB, the file has 2 KB.
    CHECK(refusal(dng.set(256, T::kLong, { 65000 }).set(257, T::kLong, { 65000 }).bytes()).find("(it loaded)") ==
          std::string::npos);
    CHECK(refusal(dng.resize(20000, 20000).bytes()).find("truncated") == 0);
}
