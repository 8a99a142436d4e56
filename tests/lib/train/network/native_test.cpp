// SPDX-License-Identifier: Apache-2.0
// The library's own select and apply against LibTorch's, on the same model file.
#include <srisp/apply.h>
#include <srisp/model.h>
#include <srisp/select.h>

#include <doctest/doctest.h>

#include "lib/train/tensor_tools.h"
#include "random_model.h"
#include "shared_files.h"
#include "train/network/network.h"
#include "train/run/model_file.h"
#include "train/tensors/resize.h"

using namespace srisp;
using namespace srisp::train;

namespace {

constexpr double kTolerance = 1e-4; // of max(1, |value|) [method 3]

std::vector<float> applied(const Model& model, const Parameters& parameters, Direction direction,
                           const torch::Tensor& image)
{
    Expected<std::shared_ptr<const Applier>> applier = Applier::create(model, parameters, direction);
    REQUIRE_MESSAGE(applier, (applier ? "" : applier.error().message));
    const std::vector<float> values = interleaved(image);
    const int height = static_cast<int>(image.size(2)), width = static_cast<int>(image.size(3));
    std::vector<float> result(values.size());
    const Status status =
        (*applier)->run({ values.data(), width, height, 3, 3 * width }, { result.data(), width, height, 3, 3 * width });
    REQUIRE_MESSAGE(status, status.error().message);
    return result;
}

void check_near(const std::vector<float>& native, const torch::Tensor& expected, const char* name)
{
    const Difference difference = compare(native, values_of(expected));
    INFO(name, ": ", difference.text);
    CHECK(difference.largest_relative <= kTolerance);
}

void check_choice(const Parameters& parameters, const ChosenParameters& choice)
{
    for (int l = 0; l < 4; ++l)
        check_near(parameters.tone_weights[l], choice.weights.at("tone." + std::to_string(l)), "tone weights");
    check_near(parameters.gamma_weights, choice.weights.at("gamma"), "gamma weights");
    check_near(parameters.color_weights, choice.weights.at("color"), "colour weights");
    check_near(parameters.white_balance_weights, choice.weights.at("white_balance"), "white-balance weights");
    check_near(parameters.gain_weights, choice.weights.at("gain"), "gain weights");
    check_near({ parameters.gamma }, choice.gamma, "gamma");
    check_near({ parameters.color.begin(), parameters.color.end() }, choice.color, "colour");
    check_near({ parameters.white_balance.begin(), parameters.white_balance.end() }, choice.white_balance,
               "white balance");
    check_near({ parameters.gain }, choice.gain, "gain");
    REQUIRE(parameters.brightness_sd_ev.has_value() == choice.log_deviation.defined());
    if (parameters.brightness_sd_ev)
        check_near({ *parameters.brightness_sd_ev }, choice.log_deviation.exp() / std::log(2.0), "deviation");
}

void use_choice(Parameters& parameters, const ChosenParameters& choice)
{
    for (int l = 0; l < 4; ++l)
        parameters.tone_weights[l] = values_of(choice.weights.at("tone." + std::to_string(l)));
    parameters.gamma = choice.gamma.item<float>();
    parameters.gain = choice.gain.item<float>();
    const std::vector<float> color = values_of(choice.color), white_balance = values_of(choice.white_balance);
    std::copy(color.begin(), color.end(), parameters.color.begin());
    std::copy(white_balance.begin(), white_balance.end(), parameters.white_balance.begin());
}

/// One photo and one reference through both; `seed` makes the images.
void check_model(const std::string& path, std::uint64_t seed)
{
    const torch::NoGradGuard no_gradient;
    Expected<std::shared_ptr<const Model>> native = Model::load(path);
    REQUIRE_MESSAGE(native, (native ? "" : native.error().message));
    Expected<LoadedModel> learned = load_model(path);
    REQUIRE_MESSAGE(learned, (learned ? "" : learned.error().message));

    const torch::Tensor source = smooth_images(1, kThumbnailSize, kThumbnailSize, seed);
    const torch::Tensor reference = smooth_images(1, kThumbnailSize, kThumbnailSize, seed + 1, 0, 0.5);
    Thumbnail source_thumbnail, reference_thumbnail;
    source_thumbnail.rgb = interleaved(source);
    reference_thumbnail.rgb = interleaved(reference);
    Expected<Parameters> parameters = srisp::select(**native, source_thumbnail, reference_thumbnail);
    REQUIRE_MESSAGE(parameters, (parameters ? "" : parameters.error().message));
    ChosenParameters choice;
    const int size = learned->model->selection_size();
    const torch::Tensor small = area_resize(source, size, size);
    const torch::Tensor reversed = learned->model->reverse(small, area_resize(reference, size, size), &choice);
    check_choice(*parameters, choice);
    check_near(applied(**native, *parameters, Direction::reverse, small), reversed[0].permute({ 1, 2, 0 }),
               "reversed thumbnail");

    // Now both apply the same parameters to the bit: the forward pass makes 5e-5 of the last bit of C.
    const torch::Tensor image = smooth_images(1, 61, 83, seed + 2);
    for (const torch::Tensor& gain : { choice.gain, torch::full({ 1 }, 0.6) }) { // below 1 much of the RAW clips
        choice.gain = gain;
        use_choice(*parameters, choice);
        const torch::Tensor raw = learned->model->apply_reverse(image, choice);
        check_near(applied(**native, *parameters, Direction::reverse, image), raw[0].permute({ 1, 2, 0 }),
                   "reversed image");
        const Difference forward = compare(applied(**native, *parameters, Direction::forward, raw),
                                           interleaved(learned->model->process(raw, choice)));
        INFO("gain ", parameters->gain, ", forward: ", forward.text);
        CHECK(forward.percentile_99_9 <= 1e-5);
        CHECK(forward.largest <= 1e-3);
    }
}

} // namespace

TEST_CASE("library and LibTorch compute the same with random models")
{
    const ScratchFolder folder;
    for (const int kernel_size : { 3, 1 })
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            INFO("kernel size ", kernel_size, ", seed ", seed);
            ModelFile file = random_model(kernel_size, seed, 4);
            file.type = seed == 3 ? "BF16" : "F16";
            check_model(file.write(folder.path("m.safetensors")), seed * 10);
        }
}

TEST_CASE("library and LibTorch compute the same with new models, as training starts with them")
{
    const ScratchFolder folder;
    const std::string path = folder.path("m.safetensors");
    for (const auto& [kernel_size, selection_size] :
         std::vector<std::pair<std::string, int>>{ { "3", 64 }, { "1", 96 }, { "1", 128 } }) {
        ModelSettings settings;
        settings.kernel_size = kernel_size;
        settings.selection_size = selection_size;
        const std::shared_ptr<Unprocessor> model = make_unprocessor(settings, 3);
        const Status status =
            save_model(*model, settings, path, { { "train_data", "none" }, { "license", "none" } }, "F32");
        REQUIRE_MESSAGE(status, status.error().message);
        check_model(path, 4);
    }
}

TEST_CASE("library and LibTorch compute the same with the models that ship")
{
    for (const char* name : { "default", "spatial" }) {
        INFO("model ", name);
        check_model(std::string(SRISP_SOURCE_DIR) + "/configs/models/" + name + ".safetensors", 5);
    }
}

TEST_CASE("library and LibTorch compute the same with the prototype's models")
{
    SKIP_WITHOUT_SHARED("models/spatial.safetensors");
    check_model(shared_file("models/spatial.safetensors"), 6);
    check_model(shared_file("models/pointwise.safetensors"), 7);
}
