// SPDX-License-Identifier: Apache-2.0
// Every step of the LibTorch network against the values of an independent implementation.
#include <cmath>

#include <doctest/doctest.h>

#include "golden_values.h"
#include "lib/train/tensor_tools.h"
#include "train/network/network.h"
#include "train/run/model_file.h"
#include "train/tensors/resize.h"

using namespace srisp;
using namespace srisp::train;

namespace {

constexpr double kTolerance = 1e-4; // of max(1, |value|) [method 3]

struct Golden {
    std::shared_ptr<Network> network;
    int thumbnail_step = 0;
    std::map<std::string, Tensor> values;

    explicit Golden(const GoldenValues& file) : values(file.values)
    {
        Expected<LoadedModel> loaded = load_model(file.model);
        REQUIRE_MESSAGE(loaded, (loaded ? "" : loaded.error().message));
        network = std::dynamic_pointer_cast<Network>(loaded->model);
        REQUIRE(network);
        thumbnail_step = file.thumbnail_step(network->selection_size());
    }
    /// [height, width, 3] as [1, 3, height, width].
    torch::Tensor image(const std::string& name) const
    {
        const Tensor& tensor = values.at(name);
        return planar(tensor.values, tensor.shape[0], tensor.shape[1]);
    }

    /// parameters.`name`, for a batch of one.
    torch::Tensor parameter(const std::string& name) const
    {
        const Tensor& tensor = values.at("parameters." + name);
        return torch::tensor(tensor.values).view(tensor.shape).unsqueeze(0);
    }
    ChosenParameters choice() const
    {
        ChosenParameters choice;
        choice.gamma = parameter("gamma")[0];
        choice.color = parameter("color");
        choice.white_balance = parameter("white_balance");
        choice.gain = parameter("gain")[0];
        for (const std::string layer : { "0", "1", "2", "3" }) {
            choice.tone_reverse_weight.push_back(parameter("tone_reverse." + layer + ".weight"));
            choice.tone_reverse_bias.push_back(parameter("tone_reverse." + layer + ".bias"));
            choice.tone_forward_weight.push_back(parameter("tone_forward." + layer + ".weight"));
            choice.tone_forward_bias.push_back(parameter("tone_forward." + layer + ".bias"));
        }
        return choice;
    }
};

void check_near(const std::vector<float>& actual, const Golden& golden, const std::string& name)
{
    const Difference difference = compare(actual, golden.values.at(name).values);
    INFO(name, ": ", difference.text);
    CHECK(difference.largest_relative <= kTolerance);
}

void check_trace(const Golden& golden, const Trace& trace)
{
    for (const auto& [name, value] : trace) {
        const bool thumbnail = name.rfind("after_", 0) == 0;
        const std::int64_t step = golden.thumbnail_step;
        if (thumbnail)
            check_near(interleaved(value.slice(2, 0, c10::nullopt, step).slice(3, 0, c10::nullopt, step)), golden,
                       "thumb." + name);
        else
            check_near(values_of(value), golden, name);
    }
}

void check_choice(const Golden& golden, const ChosenParameters& choice)
{
    std::vector<torch::Tensor> tone;
    for (const char* layer : { "tone.0", "tone.1", "tone.2", "tone.3" })
        tone.push_back(choice.weights.at(layer));
    check_near(values_of(torch::cat(tone)), golden, "weights.tone");
    for (const std::string name : { "gamma", "color", "white_balance", "gain" })
        check_near(values_of(choice.weights.at(name)), golden, "weights." + name);
    check_near(values_of(choice.gamma), golden, "parameters.gamma");
    check_near(values_of(choice.color), golden, "parameters.color");
    check_near(values_of(choice.white_balance), golden, "parameters.white_balance");
    check_near(values_of(choice.gain), golden, "parameters.gain");
    check_near(values_of(choice.base), golden, "base_gain");
    REQUIRE(choice.log_deviation.defined() == (golden.values.count("brightness_sd_ev") > 0));
    if (choice.log_deviation.defined())
        check_near(values_of(choice.log_deviation.exp() / std::log(2.0)), golden, "brightness_sd_ev");
    for (std::size_t l = 0; l < 4; ++l) {
        const std::string layer = std::to_string(l);
        check_near(values_of(choice.tone_reverse_weight[l]), golden, "parameters.tone_reverse." + layer + ".weight");
        check_near(values_of(choice.tone_reverse_bias[l]), golden, "parameters.tone_reverse." + layer + ".bias");
        check_near(values_of(choice.tone_forward_weight[l]), golden, "parameters.tone_forward." + layer + ".weight");
        check_near(values_of(choice.tone_forward_bias[l]), golden, "parameters.tone_forward." + layer + ".bias");
    }
}

void check_all(const GoldenValues& file)
{
    const torch::NoGradGuard no_gradient;
    INFO("model ", file.model);
    const Golden golden(file);
    ChosenParameters choice;
    Trace trace;
    const int size = golden.network->selection_size();
    golden.network->traced_reverse(area_resize(golden.image("thumb.source"), size, size),
                                   area_resize(golden.image("thumb.reference"), size, size), choice, &trace);
    CHECK(trace.size() == (golden.values.count("source_statistics") ? 11 : 9));
    check_trace(golden, trace);
    check_choice(golden, choice);

    // Under the golden parameters: in this image the forward pass makes 5e-5 of the last bit of C.
    const ChosenParameters exact = golden.choice();
    check_near(interleaved(golden.network->apply_reverse(golden.image("image.source"), exact)), golden,
               "image.reverse");
    // C v cancels near 0 and v^(1/γ) magnifies the last bit there, hence a bound for nearly all and one for every
    // value.
    const Difference forward = compare(interleaved(golden.network->process(golden.image("image.reverse"), exact)),
                                       golden.values.at("image.forward_of_reverse").values);
    INFO("image.forward_of_reverse: ", forward.text);
    CHECK(forward.percentile_99_9 <= 1e-5);
    CHECK(forward.largest <= 1e-3);
}

} // namespace

TEST_CASE("the LibTorch network matches the golden values of the models that ship")
{
    for (const char* name : { "default", "spatial" })
        check_all(shipped_golden_values(name));
}

TEST_CASE("the LibTorch network matches the golden values of three random models")
{
    SKIP_WITHOUT_SHARED("golden/values_spatial.safetensors");
    for (const char* name : { "spatial", "pointwise", "paper" })
        check_all(shared_golden_values(name));
}
