// SPDX-License-Identifier: Apache-2.0
// Every step of select and apply against the values of an independent implementation.
#include <doctest/doctest.h>
#include <srisp/apply.h>
#include <srisp/model.h>
#include <srisp/select.h>

#include "apply/tone_map.h"
#include "base/input_file.h"
#include "each_target.h"
#include "golden_values.h"
#include "image_compare.h"
#include "select/selection.h"

using namespace srisp;

namespace {

constexpr double kTolerance = 1e-4; // of max(1, |value|) [method 3]

struct Golden {
    std::shared_ptr<const Model> model;
    GoldenValues file;

    explicit Golden(const GoldenValues& golden) : file(golden)
    {
        Expected<std::shared_ptr<const Model>> loaded = Model::load(file.model);
        REQUIRE_MESSAGE(loaded, (loaded ? "" : loaded.error().message));
        model = *loaded;
    }
    const Tensor& tensor(const std::string& name) const { return file.values.at(name); }
    const std::vector<float>& at(const std::string& name) const { return tensor(name).values; }
    Thumbnail thumbnail(const std::string& name) const
    {
        Thumbnail result;
        result.rgb = at("thumb." + name);
        return result;
    }
};

template<class Values> void check_near(const Values& actual, const Golden& golden, const std::string& name)
{
    const Difference difference = compare(actual, golden.at(name));
    INFO(name, ": ", difference.text);
    CHECK(difference.largest_relative <= kTolerance);
}

/// Every `step`th row and column of a running thumbnail, interleaved as in the golden file.
std::vector<float> some_of(const PlanarThumbnail& thumbnail, int step)
{
    std::vector<float> values;
    for (int y = 0; y < thumbnail.size(); y += step)
        for (int x = 0; x < thumbnail.size(); x += step)
            for (int c = 0; c < 3; ++c)
                values.push_back(thumbnail.planes().plane(c)[y * thumbnail.size() + x]);
    return values;
}

void check_mixed_kernels(const Golden& golden, const Parameters& parameters)
{
    const ModelData& model = model_data(*golden.model);
    for (int l = 0; l < kToneLayers; ++l)
        for (const bool reverse : { true, false }) {
            const ToneDictionary& dictionary = reverse ? model.tone_reverse : model.tone_forward;
            const ConvolutionWeights mixed = mix_layer(dictionary[l], parameters.tone_weights[l]);
            const std::string name =
                std::string("parameters.tone_") + (reverse ? "reverse." : "forward.") + std::to_string(l);
            check_near(mixed.weight, golden, name + ".weight");
            check_near(mixed.bias, golden, name + ".bias");
        }
}

void check_selection(const Golden& golden)
{
    SelectionTrace trace;
    const ModelData& model = model_data(*golden.model);
    const Parameters p = select_parameters(model, golden.thumbnail("source"),
                                           reference_features(model, golden.thumbnail("reference")), nullptr, &trace);
    if (golden.file.values.count("source_statistics")) {
        check_near(trace.source_statistics, golden, "source_statistics");
        check_near(trace.reference_statistics, golden, "reference_statistics");
    }
    check_near(trace.source_features, golden, "source_features");
    check_near(trace.reference_features, golden, "reference_features");
    check_near(trace.fused_features, golden, "fused_features");
    check_near(trace.base_gain, golden, "base_gain");
    std::vector<float> tone_weights;
    for (const std::vector<float>& weights : p.tone_weights)
        tone_weights.insert(tone_weights.end(), weights.begin(), weights.end());
    check_near(tone_weights, golden, "weights.tone");
    check_near(p.gamma_weights, golden, "weights.gamma");
    check_near(p.color_weights, golden, "weights.color");
    check_near(p.white_balance_weights, golden, "weights.white_balance");
    check_near(p.gain_weights, golden, "weights.gain");
    check_near(std::vector<float>{ p.gain }, golden, "parameters.gain");
    check_near(std::vector<float>{ p.gamma }, golden, "parameters.gamma");
    check_near(p.color, golden, "parameters.color");
    check_near(p.white_balance, golden, "parameters.white_balance");
    if (golden.file.values.count("brightness_sd_ev"))
        check_near(std::vector<float>{ p.brightness_sd_ev.value() }, golden, "brightness_sd_ev");
    else
        CHECK(!p.brightness_sd_ev);
    check_mixed_kernels(golden, p);
    const int step = golden.file.thumbnail_step(model.selection_size);
    check_near(some_of(trace.after_tone, step), golden, "thumb.after_tone");
    check_near(some_of(trace.after_gamma, step), golden, "thumb.after_gamma");
    check_near(some_of(trace.after_color, step), golden, "thumb.after_color");
    check_near(some_of(trace.after_white_balance, step), golden, "thumb.after_white_balance");
    check_near(some_of(trace.after_gain, step), golden, "thumb.after_gain");
}

std::vector<float> applied(const Golden& golden, const Parameters& parameters, const std::string& name,
                           Direction direction)
{
    const Tensor& image = golden.tensor(name);
    const int height = static_cast<int>(image.shape[0]), width = static_cast<int>(image.shape[1]);
    Expected<std::shared_ptr<const Applier>> applier = Applier::create(*golden.model, parameters, direction);
    REQUIRE_MESSAGE(applier, (applier ? "" : applier.error().message));
    std::vector<float> result(image.values.size());
    const Status status = (*applier)->run({ image.values.data(), width, height, 3, 3 * width },
                                          { result.data(), width, height, 3, 3 * width });
    REQUIRE_MESSAGE(status, status.error().message);
    return result;
}

void check_images(const Golden& golden)
{
    Expected<Parameters> parameters =
        srisp::select(*golden.model, golden.thumbnail("source"), golden.thumbnail("reference"));
    REQUIRE_MESSAGE(parameters, (parameters ? "" : parameters.error().message));
    check_near(applied(golden, *parameters, "image.source", Direction::reverse), golden, "image.reverse");

    // C v cancels near 0 and v^(1/γ) magnifies the last bit there, hence a bound for nearly all and one for every
    // value.
    const Difference forward = compare(applied(golden, *parameters, "image.reverse", Direction::forward),
                                       golden.at("image.forward_of_reverse"));
    INFO("image.forward_of_reverse: ", forward.text);
    CHECK(forward.percentile_99_9 <= 1e-5);
    CHECK(forward.largest <= 1e-3);
}

void check_all(const GoldenValues& file)
{
    INFO("model ", file.model);
    const Golden golden(file);
    on_each_instruction_set([&] {
        check_selection(golden);
        check_images(golden);
    });
}

} // namespace

TEST_CASE("select and apply match the golden values of the models that ship on every instruction set")
{
    for (const char* name : { "default", "spatial" })
        check_all(shipped_golden_values(name));
}

TEST_CASE("select and apply match the golden values of three random models on every instruction set")
{
    SKIP_WITHOUT_SHARED("golden/values_spatial.safetensors");
    for (const char* name : { "spatial", "pointwise", "paper" })
        check_all(shared_golden_values(name));
}
