// SPDX-License-Identifier: Apache-2.0
#include "result/sensor_image.h"

#include <cmath>

#include <doctest/doctest.h>
#include <srisp/metadata.h>

#include "result/kept_results.h"

using namespace srisp;

namespace {

/// A RAW-like image in memory: channel c of pixel (x, y), counted from the data window's first, is 0.1 (c + 1) + a bit
/// of its place.
class MadeSource : public PixelSource {
public:
    explicit MadeSource(OIIO::ImageSpec spec) : m_spec(std::move(spec)) {}

    static float value(int x, int y, int c) { return 0.2f * float(c + 1) + 0.001f * float(x) + 0.0001f * float(y); }

    std::optional<OIIO::ImageSpec> find_level(int subimage, int miplevel) override
    {
        return subimage == 0 && miplevel == 0 ? std::optional<OIIO::ImageSpec>(m_spec) : std::nullopt;
    }
    Status read_rows(int, int, int y0, int y1, float* rows) override
    {
        for (int y = y0; y < y1; ++y)
            for (int x = 0; x < m_spec.width; ++x)
                for (int c = 0; c < m_spec.nchannels; ++c)
                    *rows++ = value(x, y, c);
        return {};
    }
    const std::string& name() const override { return m_name; }
    const std::string& key() const override { return m_name; }

private:
    OIIO::ImageSpec m_spec;
    std::string m_name = "image 'made'";
};

OIIO::ImageSpec made_spec(int width, int height, int channels = 3)
{
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeFloat);
    CameraFacts facts;
    facts.make = "Maker";
    facts.model = "Model";
    facts.cfa_pattern = "GBRG";
    facts.black_level = { 512, 513, 514, 515 };
    facts.white_level = 16383;
    facts.noise_profile = { 0.001, 1e-5 };
    write_camera(spec, facts);
    return spec;
}

struct Made {
    OIIO::ImageSpec spec;
    std::vector<float> pixels;
    std::string error;
};

Made make(Recipe recipe, const OIIO::ImageSpec& source)
{
    static KeptResults kept;
    recipe.action = Recipe::Action::sensor;
    if (recipe.name.empty())
        recipe.name = "made.exr";
    const auto image = open_computed_image(recipe, std::make_unique<MadeSource>(source), {}, kept);
    if (!image)
        return { {}, {}, image.error().message };
    const auto spec = (*image)->full_spec(0, 0, 1);
    if (!spec)
        return { {}, {}, spec.error().message };
    Made made{ **spec, {}, "" };
    const std::size_t row = std::size_t(made.spec.width) * std::size_t(made.spec.nchannels);
    made.pixels.resize(row * std::size_t(made.spec.height));
    const Status read = (*image)->read(0, 0, 1, 0, made.spec.width, 0, made.spec.height, made.pixels.data(), row);
    if (!read)
        made.error = read.error().message;
    return made;
}

Recipe with_mosaic(Mosaic mosaic)
{
    Recipe recipe;
    recipe.mosaic = mosaic;
    return recipe;
}

Recipe with_noise(const std::string& noise)
{
    Recipe recipe;
    recipe.noise = noise;
    return recipe;
}

} // namespace

TEST_CASE("a mosaic has one channel, the reference's phase, and of each pixel the value of its filter")
{
    const Made made = make(with_mosaic(Mosaic::reference), made_spec(5, 3));
    REQUIRE(made.error == "");
    CHECK(made.spec.nchannels == 1);
    CHECK(recorded_sensor_values(made.spec).cfa_pattern == "GBRG");
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) {
            const int color = y % 2 == 0 ? (x % 2 == 0 ? 1 : 2) : (x % 2 == 0 ? 0 : 1);
            CHECK(made.pixels[std::size_t(y * 5 + x)] == MadeSource::value(x, y, color));
        }
}

TEST_CASE("a data window that begins at odd numbers keeps the phase of pixel (0, 0)")
{
    OIIO::ImageSpec spec = made_spec(4, 4);
    spec.x = 3;
    spec.y = -1;
    const Made made = make(with_mosaic(Mosaic::rggb), spec);
    REQUIRE(made.error == "");
    CHECK(recorded_sensor_values(made.spec).cfa_pattern == "RGGB");
    CHECK(made.pixels[0] == MadeSource::value(0, 0, 2)); // column 3, row -1: blue
    CHECK(made.pixels[1] == MadeSource::value(1, 0, 1));
    CHECK(made.pixels[5] == MadeSource::value(1, 1, 0));
}

TEST_CASE("the record line alone tells a mosaic's phase, levels and noise, as TIFF and PNG keep no more")
{
    Recipe recipe = with_mosaic(Mosaic::reference);
    recipe.levels = Levels::camera;
    recipe.noise = "shot=0.01,0.02,0.03,read=1e-4";
    const Made made = make(recipe, made_spec(4, 4));
    REQUIRE(made.error == "");
    OIIO::ImageSpec file(4, 4, 1, OIIO::TypeUInt16);
    file.attribute("ImageDescription", made.spec.get_string_attribute("ImageDescription"));
    const SensorValues values = recorded_sensor_values(file);
    CHECK(values.cfa_pattern == "GBRG");
    CHECK(values.black_level[3] == 515 / 65535.0f);
    CHECK(values.white_level == 16383 / 65535.0f);
    CHECK(values.noise_profile == std::vector<double>{ 0.01, 1e-4, 0.02, 1e-4, 0.03, 1e-4 });
    CHECK(is_unprocessed(file));
}

TEST_CASE("with the camera's levels values are whole codes, each colour above its own black")
{
    Recipe recipe = with_mosaic(Mosaic::reference);
    recipe.levels = Levels::camera;
    const Made made = make(recipe, made_spec(2, 2));
    REQUIRE(made.error == "");
    const auto code = [](float value, float black) { return std::round(black + value * (16383 - black)) / 65535; };
    CHECK(made.pixels[0] == doctest::Approx(code(MadeSource::value(0, 0, 1), 513)).epsilon(1e-6));
    CHECK(made.pixels[1] == doctest::Approx(code(MadeSource::value(1, 0, 2), 514)).epsilon(1e-6));
    CHECK(made.pixels[2] == doctest::Approx(code(MadeSource::value(0, 1, 0), 512)).epsilon(1e-6));
    CHECK(made.pixels[3] == doctest::Approx(code(MadeSource::value(1, 1, 1), 515)).epsilon(1e-6));
    for (const float value : made.pixels)
        CHECK(value * 65535 == doctest::Approx(std::round(value * 65535)).epsilon(1e-6));
}

TEST_CASE("noise depends on its seed and the photo's name, and on nothing else")
{
    const OIIO::ImageSpec spec = made_spec(40, 30);
    const Made first = make(with_noise("reference"), spec);
    REQUIRE(first.error == "");
    CHECK(first.spec.nchannels == 3);
    CHECK(first.pixels == make(with_noise("reference"), spec).pixels);
    Recipe other_seed = with_noise("reference");
    other_seed.noise_seed = 1;
    CHECK(first.pixels != make(other_seed, spec).pixels);
    Recipe other_name = with_noise("reference");
    other_name.name = "other.exr";
    CHECK(first.pixels != make(other_name, spec).pixels);
    // Three channels have noise of their own.
    CHECK(first.pixels[0] - MadeSource::value(0, 0, 0) != first.pixels[1] - MadeSource::value(0, 0, 1));
}

TEST_CASE("noise of a crop is that of its place in the whole image")
{
    Recipe recipe = with_mosaic(Mosaic::rggb);
    recipe.noise = "shot=0.001,read=1e-4";
    OIIO::ImageSpec moved = made_spec(8, 8);
    moved.x = 5;
    const Made whole = make(recipe, made_spec(16, 8)), crop = make(recipe, moved);
    REQUIRE(crop.error == "");
    // Other values have other shot noise, but pixel by pixel the same random numbers: both are read noise at black.
    recipe.noise = "shot=0,read=1e-4";
    const Made whole_read = make(recipe, made_spec(16, 8)), crop_read = make(recipe, moved);
    for (int x = 0; x < 8; ++x) {
        const int color = (x + 5) % 2;
        const float noise = whole_read.pixels[std::size_t(x + 5)] - MadeSource::value(x + 5, 0, color);
        CHECK(crop_read.pixels[std::size_t(x)] - MadeSource::value(x, 0, color) ==
              doctest::Approx(noise).epsilon(1e-3));
    }
}

TEST_CASE("a mosaic takes noise later, and keeps its levels")
{
    Recipe recipe = with_mosaic(Mosaic::reference);
    recipe.levels = Levels::camera;
    OIIO::ImageSpec mosaic = made_spec(64, 64, 1);
    SensorValues values;
    values.cfa_pattern = "RGGB";
    values.black_level.fill(0.1f);
    values.white_level = 0.9f;
    record_sensor_values(mosaic, values);
    const Made made = make(with_noise("shot=0,read=0.0001"), mosaic);
    REQUIRE(made.error == "");
    double sum = 0, squares = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const double noise = made.pixels[std::size_t(y * 64 + x)] - MadeSource::value(x, y, 0);
            sum += noise;
            squares += noise * noise;
        }
    CHECK(std::abs(sum / 4096) < 0.0005);
    CHECK(std::sqrt(squares / 4096) == doctest::Approx(0.01 * 0.8).epsilon(0.05)); // of the range from black to white
    CHECK(recorded_sensor_values(made.spec).white_level == 0.9f);
}

TEST_CASE("a sensor is full at 1, and has values below black")
{
    OIIO::ImageSpec spec = made_spec(64, 64);
    const Made made = make(with_noise("shot=0,read=0.09"), spec);
    REQUIRE(made.error == "");
    CHECK(*std::max_element(made.pixels.begin(), made.pixels.end()) == 1);
    CHECK(*std::min_element(made.pixels.begin(), made.pixels.end()) < 0);
}

TEST_CASE("where the reference's filters or levels are not known, what is taken for them is noted")
{
    Recipe recipe = with_mosaic(Mosaic::reference);
    recipe.noise = "shot=0.01,read=1e-4";
    const Made made = make(recipe, OIIO::ImageSpec(4, 4, 3, OIIO::TypeFloat));
    REQUIRE(made.error == "");
    CHECK(made.spec.get_string_attribute("unprocess:notes") ==
          "the phase of the reference's filters is not known, so the mosaic has RGGB; the reference's levels are not "
          "known, so black is 2048 and white 65535");
    CHECK(recorded_sensor(made.spec).black_level[0] == 2048);
}

TEST_CASE("levels of a reference of floats, whose white is 1, are not those of a file of integers")
{
    OIIO::ImageSpec spec = made_spec(4, 4);
    CameraFacts facts;
    facts.white_level = 1;
    write_camera(spec, facts);
    Recipe recipe = with_mosaic(Mosaic::rggb);
    recipe.levels = Levels::camera;
    const Made made = make(recipe, spec);
    REQUIRE(made.error == "");
    CHECK(recorded_sensor_values(made.spec).white_level == 1);
    CHECK(recorded_sensor_values(made.spec).black_level[0] == 2048 / 65535.0f);
}

TEST_CASE("what no sensor can see is refused, each with its own message")
{
    const auto error = [](const Recipe& recipe, const OIIO::ImageSpec& spec) { return make(recipe, spec).error; };
    CHECK(error(with_mosaic(Mosaic::rggb), made_spec(4, 4, 2)).find("image 'made': ") == 0);
    CHECK(error(with_mosaic(Mosaic::rggb), made_spec(4, 4, 1)) ==
          "image 'made': has 1 channel; a sensor sees images whose first three are R, G, B");
    OIIO::ImageSpec xtrans = made_spec(12, 12);
    CameraFacts facts;
    facts.cfa_pattern = "GGRGGBGGBGGRBRGRBGGGBGGRGGRGGBRBGBRG";
    write_camera(xtrans, facts);
    CHECK(error(with_mosaic(Mosaic::reference), xtrans).find("X-Trans filters") != std::string::npos);
    CHECK(error(with_mosaic(Mosaic::reference), xtrans).find("phase=RGGB names one") != std::string::npos);
    CHECK(error(with_mosaic(Mosaic::bggr), xtrans) == "");
    OIIO::ImageSpec mosaic = make(with_mosaic(Mosaic::rggb), made_spec(4, 4)).spec;
    CHECK(error(with_mosaic(Mosaic::rggb), mosaic) == "image 'made': is a mosaic already");
    const OIIO::ImageSpec noisy = make(with_noise("upi"), made_spec(4, 4)).spec;
    CHECK(error(with_noise("upi"), noisy) == "image 'made': has noise already");
    CHECK(error(with_noise("iso=800"), OIIO::ImageSpec(4, 4, 3, OIIO::TypeFloat)).find("which camera") !=
          std::string::npos);
    CHECK(error(with_noise("reference"), OIIO::ImageSpec(4, 4, 3, OIIO::TypeFloat)) ==
          "image 'made': the image tells of its reference no NoiseProfile; shot=S,read=R gives the figures");
    OIIO::ImageSpec processed = made_spec(4, 4);
    mark_result(processed, Direction::forward);
    CHECK(error(with_noise("upi"), processed) == "image 'made': is a processed picture; a sensor sees RAW-like images");
    OIIO::ImageSpec deep = made_spec(4, 4);
    deep.deep = true;
    CHECK(error(with_noise("upi"), deep) == "image 'made': is deep or a volume, which no sensor sees");
}
