// SPDX-License-Identifier: Apache-2.0
// What model format srisp-6 adds, against an independent implementation: tests/golden/anchor_network.py.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <utility>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <srisp/model.h>

#include "base/input_file.h"
#include "features/image_features.h"
#include "features/match_features.h"
#include "image_compare.h"
#include "kernels/color_blocks.h"
#include "model/model_data.h"
#include "random_model.h"
#include "select/selection.h"
#include "shared_files.h"

using namespace srisp;

namespace {

constexpr double kTolerance = 1e-4; // of max(1, |value|) [method 3]

std::vector<float> expected(const char* name)
{
    std::ifstream file(SRISP_SOURCE_DIR "/tests/golden/anchor_network.json");
    REQUIRE(file);
    return nlohmann::json::parse(file).at(name).get<std::vector<float>>();
}

template<class Values> void check_near(const Values& actual, const char* name)
{
    const Difference difference = compare(actual, expected(name));
    INFO(name, ": ", difference.text);
    CHECK(difference.largest_relative <= kTolerance);
}

std::vector<float> made_up_image(int height, int width, double phase = 0, double scale = 1)
{
    std::vector<float> planes;
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double wave = 0.5 + 0.5 * std::sin(0.013 * x + 0.007 * (c + 1) * y + c + phase);
                planes.push_back(static_cast<float>(scale * std::min(1.05 * wave * wave, 1.0)));
            }
    return planes;
}

Tensor made_up(std::vector<std::int64_t> shape, double scale, double (*wave)(double), double step, int layer)
{
    Tensor tensor{ std::move(shape), {} };
    std::int64_t count = 1;
    for (const std::int64_t size : tensor.shape)
        count *= size;
    for (std::int64_t i = 0; i < count; ++i)
        tensor.values.push_back(static_cast<float>(scale * wave(step * static_cast<double>(i) + layer)));
    return tensor;
}

} // namespace

TEST_CASE("quantile features of large and of odd images")
{
    std::vector<float> square = made_up_image(256, 256), odd = made_up_image(150, 70);
    check_near(quantile_features(reduced({ { square.data(), 256 * 256 }, 256, 256 })), "features_256x256");
    check_near(quantile_features(reduced({ { odd.data(), 150 * 70 }, 150, 70 })), "features_150x70");
}

TEST_CASE("quantile features of one pixel, and of darkness")
{
    float pixel[] = { 1, 0.5f, 0 };
    const auto features = quantile_features(reduced({ { pixel, 1 }, 1, 1 }));
    CHECK(features[0] == doctest::Approx(1));
    CHECK(features[10] == doctest::Approx(std::log(0.5) / 2 + 1));
    CHECK(features[20] == doctest::Approx(std::log(1e-4) / 2 + 1));
    CHECK(features[30] == doctest::Approx(std::log(0.5) / 2 + 1));
    CHECK(features[40] == 1);
    CHECK(features[41] == 0);
    for (const int first : { 43, 57 }) { // R/G of all pixels and of the bright ones, B/G after each
        CHECK(features[first] == doctest::Approx(std::log(1.002 / 0.502)));
        CHECK(features[first + 7] == doctest::Approx(std::log(0.002 / 0.502)));
    }
}

TEST_CASE("match features of large and of odd images")
{
    const auto check = [](int height, int width, const char* name) {
        std::vector<float> photo = made_up_image(height, width), reference = made_up_image(height, width, 0.6, 0.5);
        const std::ptrdiff_t pixels = height * width;
        check_near(match_features(reduced({ { photo.data(), pixels }, height, width }),
                                  reduced({ { reference.data(), pixels }, height, width })),
                   name);
    };
    check(256, 256, "match_256x256");
    check(150, 70, "match_150x70");
}

TEST_CASE("match features find by how much one image's colours are moved")
{
    // 400 colours as far apart as a few cells, seen through the same camera with γ = 2.2 (features 17 to 33).
    constexpr int side = 20, pixels = side * side;
    const double gains[] = { std::exp(-0.36), 1, std::exp(0.24) }; // 3 and 2 cells
    const double brightness = std::exp(-0.5);
    std::vector<float> photo(3 * pixels), reference(3 * pixels);
    Random random(1);
    for (int i = 0; i < pixels; ++i) {
        const double value = std::exp(-3 + 0.8 * random.uniform(-1, 1));
        const double y[] = { value * std::exp(0.5 * random.uniform(-1, 1)), value,
                             value * std::exp(0.5 * random.uniform(-1, 1)) };
        const double seen[] = { 0.60 * y[0] + 0.32 * y[1] + 0.08 * y[2], 0.15 * y[0] + 0.70 * y[1] + 0.15 * y[2],
                                0.05 * y[0] + 0.28 * y[1] + 0.67 * y[2] };
        const double sum = seen[0] + seen[1] + seen[2],
                     moved = seen[0] * gains[0] + seen[1] * gains[1] + seen[2] * gains[2];
        for (int c = 0; c < 3; ++c) {
            photo[c * pixels + i] = static_cast<float>(y[c]);
            reference[c * pixels + i] = static_cast<float>(seen[c] * gains[c] * brightness * sum / moved);
        }
    }
    const auto features = match_features(reduced({ { photo.data(), pixels }, side, side }),
                                         reduced({ { reference.data(), pixels }, side, side }));
    CHECK(features[17] == doctest::Approx(-0.36).epsilon(0.05));
    CHECK(features[19] == doctest::Approx(0.24).epsilon(0.05));
    CHECK(features[21] == doctest::Approx(-0.5).epsilon(0.05));
    CHECK(features[23] > 0.7); // they match
    CHECK(features[18] < 0.1); // and only so
}

TEST_CASE("match features of an image without pixels that weigh say that all shifts are as likely")
{
    std::vector<float> white(3 * 16, 1), gray(3 * 16, 0.2f);
    for (auto [photo, reference] : { std::pair(&white, &gray), std::pair(&gray, &white), std::pair(&white, &white) }) {
        const auto features =
            match_features(reduced({ { photo->data(), 16 }, 4, 4 }), reduced({ { reference->data(), 16 }, 4, 4 }));
        const double deviation = std::sqrt((32 * 32 - 1) / 12.0);
        for (const int first : { 0, 7, 17, 24, 34, 41 }) {
            CHECK(features[first] == doctest::Approx(-0.5 * 0.12));
            CHECK(features[first + 1] == doctest::Approx(deviation * 0.12));
            CHECK(features[first + 4] == doctest::Approx(-0.5 * 0.25));
            CHECK(features[first + 5] == doctest::Approx(deviation * 0.25));
            CHECK(features[first + 6] == 0);
        }
    }
}

TEST_CASE("a gain below 1 rebuilds clipped highlights")
{
    constexpr int colors = 61;
    const ColorBlocks blocks{ { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, 1, { 2, 1, 1.25f }, { 0.6f, 0.6f, 0.6f }, true };
    const float* const balance = blocks.white_balance;
    std::vector<float> rgb(3 * colors + kRowSlack * 3), result;
    const Planes planes{ rgb.data(), colors + std::ptrdiff_t(kRowSlack) };
    for (int i = 0; i < colors; ++i)
        for (int c = 0; c < 3; ++c) {
            const double exposure = 0.05 * i, tint = 1 + 0.1 * std::sin(5 * exposure + 2 * c);
            planes.plane(c)[i] = static_cast<float>(std::min(exposure * tint / balance[c], 1.0));
        }
    before_tone_map(blocks, planes, planes, colors);
    for (int i = 0; i < colors; ++i)
        for (int c = 0; c < 3; ++c)
            result.push_back(planes.plane(c)[i]);
    check_near(result, "process_gains");
}

TEST_CASE("the anchor's network corrects the golden model's gains, and no white-balance gain is below 1")
{
    SKIP_WITHOUT_SHARED("golden/model_spatial.safetensors");
    const std::string path = shared_file("golden/model_spatial.safetensors");
    Expected<std::string> bytes = read_file(path, 1 << 26, path);
    REQUIRE(bytes);
    Expected<SafeTensors> golden = parse_safetensors(*bytes, path);
    REQUIRE(golden);
    ModelFile file{ golden->metadata, golden->tensors };
    file.metadata["format"] = "srisp-6";
    const std::int64_t sizes[] = { 24 + 2 * kQuantileFeatures + kMatchFeatures, 256, 256, 256, 3 };
    for (int l = 0; l < 4; ++l) {
        const std::string layer = "anchor_network." + std::to_string(l);
        file.tensors[layer + ".weight"] = made_up(
            { sizes[l + 1], sizes[l] }, 0.05, [](double v) { return std::sin(v); }, 0.7, l);
        file.tensors[layer + ".bias"] = made_up(
            { sizes[l + 1] }, 0.05, [](double v) { return std::cos(v); }, 1, l);
    }
    Expected<std::unique_ptr<ModelData>> model = parse_model(file.bytes(), path);
    REQUIRE_MESSAGE(model, (model ? "" : model.error().message));

    const std::string values_path = shared_file("golden/values_spatial.safetensors");
    Expected<std::string> values_bytes = read_file(values_path, 1 << 26, values_path);
    REQUIRE(values_bytes);
    Expected<SafeTensors> values = parse_safetensors(*values_bytes, values_path);
    REQUIRE(values);
    Thumbnail source, reference;
    source.rgb = values->tensors.at("thumb.source").values;
    reference.rgb = values->tensors.at("thumb.reference").values;
    SelectionTrace trace;
    const Parameters parameters = select_parameters(**model, source, reference, nullptr, &trace);
    check_near(trace.base_gain, "base_gain");
    check_near(parameters.white_balance, "white_balance");
    check_near(std::array<float, 1>{ parameters.gain }, "gain");
    CHECK(*std::min_element(parameters.white_balance.begin(), parameters.white_balance.end()) == 1);
}

TEST_CASE("a network without an anchor, or of another shape, is refused")
{
    ModelFile file = random_model(3, 1);
    file.metadata["format"] = "srisp-6";
    Expected<std::unique_ptr<ModelData>> model = parse_model(file.bytes(), "m");
    REQUIRE(!model);
    CHECK(model.error().message == "m: has no tensor 'anchor_network.0.weight'");
    file.metadata["anchor"] = "0";
    model = parse_model(file.bytes(), "m");
    REQUIRE(!model);
    CHECK(model.error().message == "m: metadata 'format' is srisp-6 but 'anchor' is 0; its network needs the anchor");
}
