// SPDX-License-Identifier: Apache-2.0
// What model format srisp-7 adds, against an independent implementation: tests/golden/anchor_network.py.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <utility>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <srisp/model.h>
#include <srisp/select.h>

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

std::vector<float> expected(const std::string& name)
{
    std::ifstream file(SRISP_SOURCE_DIR "/tests/golden/anchor_network.json");
    REQUIRE(file);
    return nlohmann::json::parse(file).at(name).get<std::vector<float>>();
}

template<class Values> void check_near(const Values& actual, const std::string& name)
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

Tensor made_up(std::vector<std::int64_t> shape, double (*wave)(double), double step, int layer)
{
    Tensor tensor{ std::move(shape), {} };
    std::int64_t count = 1;
    for (const std::int64_t size : tensor.shape)
        count *= size;
    for (std::int64_t i = 0; i < count; ++i)
        tensor.values.push_back(static_cast<float>(0.05 * wave(step * static_cast<double>(i) + layer)));
    return tensor;
}

/// Affine layers of so many inputs, then outputs.
void add_made_up_layers(ModelFile& file, const std::string& name, const std::vector<std::int64_t>& widths)
{
    for (std::size_t l = 0; l + 1 < widths.size(); ++l) {
        const std::string layer = name + "." + std::to_string(l);
        file.tensors[layer + ".weight"] = made_up(
            { widths[l + 1], widths[l] }, [](double v) { return std::sin(v); }, 0.7, int(l));
        file.tensors[layer + ".bias"] = made_up(
            { widths[l + 1] }, [](double v) { return std::cos(v); }, 1, int(l));
    }
}

SafeTensors shared_tensors(const std::string& name)
{
    const std::string path = shared_file(name);
    Expected<std::string> bytes = read_file(path, 1 << 26, path);
    REQUIRE(bytes);
    Expected<SafeTensors> file = parse_safetensors(*bytes, path);
    REQUIRE(file);
    return std::move(*file);
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

TEST_CASE("the anchor's network corrects the golden model's gains and tells their deviation, at each size")
{
    SKIP_WITHOUT_SHARED("golden/model_spatial.safetensors");
    const SafeTensors golden = shared_tensors("golden/model_spatial.safetensors");
    const SafeTensors values = shared_tensors("golden/values_spatial.safetensors");
    Thumbnail source, reference;
    source.rgb = values.tensors.at("thumb.source").values;
    reference.rgb = values.tensors.at("thumb.reference").values;
    for (const std::string size : { "256", "96" }) {
        INFO(size, " pixels");
        ModelFile file{ golden.metadata, golden.tensors };
        file.metadata["format"] = "srisp-7";
        file.metadata["selection_size"] = size;
        add_made_up_layers(file, "anchor_network", { 24 + 2 * kQuantileFeatures + kMatchFeatures, 256, 256, 256, 3 });
        add_made_up_layers(file, "anchor_deviation", { 256, 32, 1 });
        Expected<std::unique_ptr<ModelData>> model = parse_model(file.bytes(), "m");
        REQUIRE_MESSAGE(model, (model ? "" : model.error().message));
        SelectionTrace trace;
        const Parameters parameters =
            select_parameters(**model, source, reference_features(**model, reference), nullptr, &trace);
        check_near(trace.base_gain, "base_gain_" + size);
        check_near(parameters.white_balance, "white_balance_" + size);
        check_near(std::array<float, 1>{ parameters.gain }, "gain_" + size);
        check_near(std::array<float, 1>{ parameters.gamma }, "gamma_" + size);
        check_near(std::array<float, 1>{ parameters.brightness_sd_ev.value() }, "brightness_sd_ev_" + size);
        CHECK(*std::min_element(parameters.white_balance.begin(), parameters.white_balance.end()) == 1);
    }
}

TEST_CASE("a thumbnail is reduced by exact area means, parts of pixels counted")
{
    const std::vector<float> planes = made_up_image(256, 256);
    Thumbnail thumbnail;
    for (std::size_t i = 0; i < thumbnail.rgb.size(); ++i)
        thumbnail.rgb[i] = planes[i % 3 * 256 * 256 + i / 3];
    const PlanarThumbnail smaller(thumbnail, 96);
    std::vector<float> some;
    for (int y = 5; y < 96; y += 17)
        for (int x = 3; x < 96; x += 23)
            for (int c = 0; c < 3; ++c)
                some.push_back(smaller.planes().plane(c)[y * 96 + x]);
    check_near(some, "area_means_96");
}

TEST_CASE("a reference that is prepared once serves all photos and gives the same bits")
{
    Thumbnail photo, other, reference;
    Random random(3);
    for (Thumbnail* thumbnail : { &photo, &other, &reference })
        for (float& value : thumbnail->rgb)
            value = random.uniform(0, thumbnail == &reference ? 0.5f : 1.0f);
    const ScratchFolder folder;
    const auto model = Model::load(random_srisp_7_model(1, 5).write(folder.path("m.safetensors")));
    REQUIRE_MESSAGE(model, (model ? "" : model.error().message));
    const auto prepared = prepare_reference(**model, reference);
    REQUIRE(prepared);
    const PreparedReference copy = *prepared;
    for (const Thumbnail* each : { &photo, &other, &photo }) {
        const auto kept = srisp::select(**model, *each, copy), fresh = srisp::select(**model, *each, reference);
        REQUIRE(kept);
        REQUIRE(fresh);
        CHECK(to_json(*kept) == to_json(*fresh));
    }
    const auto another = Model::load(random_srisp_7_model(1, 6).write(folder.path("n.safetensors")));
    REQUIRE(another);
    const auto refused = srisp::select(**another, photo, copy);
    REQUIRE(!refused);
    CHECK(refused.error().message == "the reference was prepared for the model " + (*model)->hash() + ", but '" +
                                         (*another)->path() + "' is " + (*another)->hash());
    reference.rgb[3] = NAN;
    CHECK(!prepare_reference(**model, reference));
}

TEST_CASE("an unsure brightness is noted by select, above 0.7 EV")
{
    const ScratchFolder folder;
    Thumbnail flat;
    std::fill(flat.rgb.begin(), flat.rgb.end(), 0.25f);
    for (const double deviation : { 0.5, 0.92 }) {
        const auto model = Model::load(random_srisp_7_model(1, 5, 64, deviation).write(folder.path("m.safetensors")));
        REQUIRE_MESSAGE(model, (model ? "" : model.error().message));
        std::vector<std::string> notes;
        const auto parameters = srisp::select(**model, flat, flat, &notes);
        REQUIRE(parameters);
        CHECK(parameters->brightness_sd_ev.value() == doctest::Approx(deviation));
        const std::string all = notes.empty() ? "" : notes.back();
        CHECK((all.find("the brightness is unsure, its standard deviation is 0.92 EV; brightness=EV") == 0) ==
              (deviation > 0.7));
    }
}

TEST_CASE("a model of srisp-7 without anchor, size or deviation is refused, and so is one of an older format")
{
    const auto message_after = [](auto change) {
        ModelFile file = random_srisp_7_model(3, 1);
        change(file);
        const auto model = parse_model(file.bytes(), "m");
        return model ? std::string() : model.error().message;
    };
    CHECK(message_after([](ModelFile&) {}).empty());
    CHECK(message_after([](ModelFile& file) { file.tensors.erase("anchor_network.0.weight"); }) ==
          "m: has no tensor 'anchor_network.0.weight'");
    CHECK(message_after([](ModelFile& file) { file.metadata["anchor"] = "0"; }) ==
          "m: metadata 'format' is srisp-7 but 'anchor' is 0; its network needs the anchor");
    CHECK(message_after([](ModelFile& file) { file.metadata.erase("selection_size"); }) ==
          "m: metadata 'selection_size' is missing");
    CHECK(message_after([](ModelFile& file) { file.metadata["selection_size"] = "100"; }) ==
          "m: metadata 'selection_size' is '100', must be '64' or '96' or '128' or '256'");
    CHECK(message_after([](ModelFile& file) { file.tensors.erase("anchor_deviation.1.bias"); }) ==
          "m: has no tensor 'anchor_deviation.1.bias'");
    CHECK(message_after([](ModelFile& file) {
              file.tensors["anchor_deviation.0.weight"].shape = { 256, 32 };
          }) == "m: tensor 'anchor_deviation.0.weight' has shape [256, 32], needs [32, 256]");
    CHECK(message_after([](ModelFile& file) { file.metadata["format"] = "srisp-6"; }) ==
          "m: metadata 'format' is 'srisp-6', must be 'srisp-1' or 'srisp-7'");
    CHECK(message_after([](ModelFile& file) { file.metadata["format"] = "srisp-1"; }).find("unknown tensor") !=
          std::string::npos);
}
