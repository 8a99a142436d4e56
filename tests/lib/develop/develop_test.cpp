// SPDX-License-Identifier: Apache-2.0
#include <srisp/develop.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "base/matrix3.h"
#include "base/scene_linear_space.h"

using namespace srisp;

namespace {

constexpr Matrix3 kMatrix{ 0.6071f, -0.0747f, -0.0856f, -0.7653f, 1.5365f, 0.2441f, -0.2025f, 0.2553f, 0.7315f };
constexpr std::array<float, 3> kNeutral{ 0.5f, 1, 0.7f };

DevelopSource some_source()
{
    DevelopSource source{};
    source.camera.color_matrices = { { kMatrix, 21 } };
    source.camera.as_shot_neutral = kNeutral;
    source.reference_neutral = { 0.9f, 1, 0.4f };
    return source;
}

Options options_for(const std::string& space)
{
    Options options;
    options.develop = space;
    return options;
}

Development chosen(const DevelopSource& source, const Options& options)
{
    std::vector<std::string> notes;
    auto development = choose_development(source, options, notes);
    REQUIRE_MESSAGE(development, (development ? "" : development.error().message));
    return *development;
}

std::string error_of(const DevelopSource& source, const Options& options)
{
    std::vector<std::string> notes;
    const auto development = choose_development(source, options, notes);
    return development ? "" : development.error().message;
}

std::vector<float> developed(const Development& development, std::vector<float> rgb)
{
    const int width = int(rgb.size() / 3);
    const MutableImageView view{ rgb.data(), width, 1, 3, 3 * width };
    REQUIRE(develop(development, view, view));
    return rgb;
}

void check_near(const std::vector<float>& actual, const std::vector<float>& expected, double limit)
{
    REQUIRE(actual.size() == expected.size());
    for (std::size_t i = 0; i < actual.size(); ++i)
        CHECK(std::fabs(actual[i] - expected[i]) <= limit);
}

} // namespace

TEST_CASE("a neutral at which the first channel saturates is 1, in every RGB space")
{
    for (const SceneLinearSpace& space : scene_linear_spaces()) {
        const Development development = chosen(some_source(), options_for(space.name));
        CHECK(development.space == space.name);
        CHECK(*std::min_element(development.multipliers.begin(), development.multipliers.end()) == 1);
        const std::vector<float> white = developed(development, { kNeutral[0], kNeutral[1], kNeutral[2] });
        if (development.space == "XYZ")
            check_near(white, { xyz_of(kD65)[0], 1, xyz_of(kD65)[2] }, 1e-5);
        else
            check_near(white, { 1, 1, 1 }, 1e-5);
    }
}

TEST_CASE("spaces differ by their standards' matrices alone")
{
    const std::vector<float> color{ 0.2f, 0.3f, 0.05f };
    const std::vector<float> rec709 = developed(chosen(some_source(), options_for("lin_rec709")), color);
    const std::vector<float> p3 = developed(chosen(some_source(), options_for("lin_p3d65")), color);
    const Matrix3 srgb = rgb_to_xyz(kSrgbChromaticities), p3_xyz = rgb_to_xyz(kP3D65Chromaticities);
    const Vector3 expected = product(inverse(p3_xyz), product(srgb, Vector3{ rec709[0], rec709[1], rec709[2] }));
    check_near(p3, { expected[0], expected[1], expected[2] }, 1e-5);
}

TEST_CASE("exposure is in EV, after highlights")
{
    Options options = options_for("ACEScg");
    options.exposure = 1;
    check_near(developed(chosen(some_source(), options), { 1, 1, 1 }), { 2, 2, 2 }, 1e-5);
}

TEST_CASE("white balance: the scene, the reference, a light, multipliers")
{
    Options options = options_for("ACEScg");
    const auto white_with = [&](const std::string& value) {
        REQUIRE(set_option(options, "whitebalance", value));
        return chosen(some_source(), options).multipliers;
    };
    CHECK(white_with("scene")[0] == doctest::Approx(2));
    CHECK(white_with("reference")[2] == doctest::Approx(2.5));
    // D65, of which the matrix is.
    const Vector3 d65 = product(kMatrix, xyz_of(kD65));
    CHECK(white_with("6504,9.6")[0] == doctest::Approx(d65[1] / d65[0]).epsilon(5e-3));
    const auto own = white_with("3,1.5,6");
    CHECK(own[0] == doctest::Approx(2));
    CHECK(own[1] == 1);
    CHECK(own[2] == doctest::Approx(4));
}

TEST_CASE("what is not known of the camera comes from the parameters, with a note")
{
    Parameters parameters;
    parameters.white_balance = { 2, 1, 1.5f };
    parameters.color = { 1.7f, -0.5f, -0.2f, -0.3f, 1.6f, -0.3f, 0.01f, -0.71f, 1.7f };
    DevelopSource source{};
    source.parameters = &parameters;
    std::vector<std::string> notes;
    const auto development = choose_development(source, options_for("lin_rec709"), notes);
    REQUIRE(development);
    CHECK(notes.size() == 1);
    CHECK(development->multipliers[0] == 2);
    const Matrix3 color = row_normalized(parameters.color);
    for (std::size_t i = 0; i < 9; ++i)
        CHECK(development->matrix[i] == doctest::Approx(color[i]).epsilon(1e-4));
}

TEST_CASE("highlights are clipped, blended or kept")
{
    Options options = options_for("lin_rec709");
    const std::vector<float> clipped_white{ 1, 1, 1 };
    const auto with = [&](Highlights highlights, const std::vector<float>& color) {
        options.highlights = highlights;
        return developed(chosen(some_source(), options), color);
    };
    check_near(with(Highlights::clip, clipped_white), { 1, 1, 1 }, 1e-5);
    // As bright as the balanced values are on average, and without colour, as clipped ones have none.
    const float mean = (2 + 1 + 1 / 0.7f) / 3;
    check_near(with(Highlights::blend, clipped_white), { mean, mean, mean }, 1e-5);
    const std::vector<float> kept = with(Highlights::keep, clipped_white);
    CHECK(kept[0] > 2);
    CHECK(kept[1] < 1);
    // Below the limit all are the same, negative values included.
    const std::vector<float> dim{ 0.1f, 0.4f, -0.01f };
    check_near(with(Highlights::clip, dim), with(Highlights::keep, dim), 0);
    check_near(with(Highlights::blend, dim), with(Highlights::keep, dim), 0);
}

TEST_CASE("an unprocessed photo's highlights are clipped where the photo was white")
{
    Parameters parameters;
    parameters.gain = 1.6f;
    parameters.white_balance = { 1 / kNeutral[0], 1 / kNeutral[1], 1 / kNeutral[2] };
    DevelopSource source = some_source();
    source.parameters = &parameters;
    Options options = options_for("ACEScg");
    // Nearly white, drawn towards the sensor's white: tinted.
    const std::vector<float> drawn{ 0.4f, 0.7f, 0.6f };
    check_near(developed(chosen(source, options), drawn), { 0.625f, 0.625f, 0.625f }, 1e-5);
    options.highlights = Highlights::blend;
    const float mean = (0.8f + 0.7f + 0.6f / 0.7f) / 3;
    check_near(developed(chosen(source, options), drawn), { mean, mean, mean }, 1e-5);
    // Whatever else is white: no channel of the photo's white is clipped.
    options.white_balance.kind = WhiteBalance::Kind::reference;
    CHECK(chosen(source, options).white == 1);
    parameters.gain = 3.2f;
    CHECK(chosen(source, options).white == doctest::Approx(0.7 / 0.4 / 3.2).epsilon(1e-5));
    parameters.white_balance = { 0.5f / kNeutral[0], 0.5f / kNeutral[1],
                                 0.5f / kNeutral[2] }; // by what numbers it is said
    parameters.gain = 6.4f;
    CHECK(chosen(source, options).white == doctest::Approx(0.7 / 0.4 / 3.2).epsilon(1e-5));
    parameters.gain = 0.7f; // white beyond the sensor's range
    CHECK(chosen(source, options).white == 1);
}

TEST_CASE("colour that is multiplied with alpha is saturated at alpha")
{
    const Development development = chosen(some_source(), options_for("ACEScg"));
    const std::vector<float> rgba{ 0.25f, 0.25f, 0.25f, 0.25f, 1, 1, 1, 0, 0.5f, 0.5f, 0.5f, 0.5f };
    std::vector<float> out(9);
    REQUIRE(develop(development, { rgba.data(), 3, 1, 4, 12 }, { out.data(), 3, 1, 3, 9 }, rgba.data() + 3));
    check_near(out, { 0.25f, 0.25f, 0.25f, 1, 1, 1, 0.5f, 0.5f, 0.5f }, 1e-5);
}

TEST_CASE("the way back is exact where nothing was clipped, from its record, too")
{
    Options options = options_for("ACES2065-1");
    options.exposure = -0.7;
    const Development development = chosen(some_source(), options);
    const auto read = development_from_json(to_json(development), "test");
    REQUIRE_MESSAGE(read, (read ? "" : read.error().message));
    CHECK(read->matrix == development.matrix);
    CHECK(read->multipliers == development.multipliers);
    CHECK(read->white == development.white);
    const std::vector<float> before{ 0.2f, 0.3f, 0.1f, 0.01f, 0.9f, 0.02f, 0, 0, 0 };
    std::vector<float> pixels = developed(development, before);
    const MutableImageView view{ pixels.data(), 3, 1, 3, 9 };
    REQUIRE(undo_development(*read, view, view));
    check_near(pixels, before, 2e-6);
}

TEST_CASE("many rows on many threads are what one row is, and NaN stays where it is")
{
    const Development development = chosen(some_source(), options_for("ACEScg"));
    const int width = 37, height = 65;
    std::vector<float> in(std::size_t(3) * width * height), out(in.size());
    for (std::size_t i = 0; i < in.size(); ++i)
        in[i] = float(i % 101) / 90;
    in[100] = std::numeric_limits<float>::quiet_NaN();
    REQUIRE(develop(development, { in.data(), width, height, 3, 3 * width },
                    { out.data(), width, height, 3, 3 * width }, nullptr, 0));
    for (std::size_t pixel = 0; pixel < in.size() / 3; ++pixel) {
        const std::vector<float> alone =
            developed(development, { in[pixel * 3], in[pixel * 3 + 1], in[pixel * 3 + 2] });
        for (std::size_t c = 0; c < 3; ++c)
            CHECK((std::isnan(alone[c]) ? std::isnan(out[pixel * 3 + c]) && pixel == 33
                                        : alone[c] == out[pixel * 3 + c]));
    }
}

TEST_CASE("what cannot be developed is said with what is missing")
{
    DevelopSource nothing{};
    CHECK(error_of(nothing, options_for("ACEScg")).find("colour matrix") != std::string::npos);
    nothing.camera.as_shot_neutral = kNeutral;
    CHECK(error_of(nothing, options_for("ACEScg")) == "no colour matrix is known of the camera");
    CHECK(error_of(some_source(), options_for("ACESgc")).find("did you mean 'ACEScg'") != std::string::npos);
    CHECK(error_of(some_source(), options_for("")) == "no colour space is named");
    Options by_light = options_for("ACEScg");
    by_light.white_balance.kind = WhiteBalance::Kind::light;
    by_light.white_balance.temperature = 5000;
    CHECK(error_of(nothing, by_light).find("needs a colour matrix") != std::string::npos);
    std::vector<float> pixels(6);
    CHECK_FALSE(develop(chosen(some_source(), options_for("ACEScg")), { pixels.data(), 2, 1, 3, 6 },
                        { pixels.data(), 1, 1, 3, 3 }));
}

TEST_CASE("a damaged record of a development is an error")
{
    const std::string whole = to_json(chosen(some_source(), options_for("ACEScg")));
    const auto error_with = [&](const std::string& from, const std::string& to) {
        std::string text = whole;
        text.replace(text.find(from), from.size(), to);
        const auto read = development_from_json(text, "image 'a.exr'");
        return read ? std::string() : read.error().message;
    };
    CHECK(error_with("ACEScg", "ACESxx").find("'space' is 'ACESxx'") != std::string::npos);
    CHECK(error_with("clip", "clamp").find("must be clip, blend or keep") != std::string::npos);
    CHECK(error_with("\"multipliers\":[", "\"multipliers\":[1,").find("must have 3 numbers, has 4") !=
          std::string::npos);
    CHECK(error_with("\"matrix\":[", "\"matrix\":[\"x\",") != "");
    CHECK(error_with("\"highlights\"", "\"highlight\"") != "");
    CHECK_FALSE(development_from_json("[]", "test"));
    CHECK_FALSE(development_from_json("{", "test"));
}
