// SPDX-License-Identifier: Apache-2.0
#include "train/run/model_file.h"

#include <filesystem>

#include <doctest/doctest.h>

#include "base/input_file.h"
#include "lib/train/tensor_tools.h"
#include "model/model_data.h"
#include "model/safetensors.h"
#include "random_model.h"
#include "train/network/network.h"

using namespace srisp;
using namespace srisp::train;

namespace {

const std::map<std::string, std::string> kMetadata = { { "train_data", "none" }, { "license", "Apache-2.0" } };

std::string contents(const std::string& path)
{
    Expected<std::string> bytes = read_file(path, 1 << 26, "test");
    REQUIRE_MESSAGE(bytes, (bytes ? "" : bytes.error().message));
    return *bytes;
}

LoadedModel loaded(const std::string& path)
{
    Expected<LoadedModel> model = load_model(path);
    REQUIRE_MESSAGE(model, (model ? "" : model.error().message));
    return *model;
}

std::string failure(const std::string& path)
{
    Expected<LoadedModel> model = load_model(path);
    return model ? "no error" : model.error().message;
}

void save(const Unprocessor& model, const ModelSettings& settings, const std::string& path, const std::string& type)
{
    const Status status = save_model(model, settings, path, kMetadata, type);
    REQUIRE_MESSAGE(status, status.error().message);
}

std::vector<ModelSettings> ablations()
{
    std::vector<ModelSettings> all(6);
    all[1].encoder_input = "plain";
    all[1].statistics = all[1].anchor = false;
    all[2].selection = "static";
    all[3].tone = "static";
    all[3].kernel_size = "1";
    all[4].selection = "intermediate";
    all[4].statistics = false; // the anchor needs them, the features do not
    all[5].gamma = "static";
    all[5].dictionary_size = 3;
    return all;
}

} // namespace

TEST_CASE("a network that is saved and loaded has the same bits")
{
    const ScratchFolder folder;
    const std::string path = folder.path("m.safetensors");
    ModelSettings settings;
    settings.dictionary_size = 4;
    const Network network(settings, 9);
    save(network, settings, path, "F32");
    const LoadedModel again = loaded(path);
    CHECK(again.settings.dictionary_size == 4);
    CHECK(again.metadata.at("train_data") == "none");
    REQUIRE(again.model->named_parameters().size() == network.named_parameters().size());
    for (const auto& item : network.named_parameters()) {
        INFO(item.key());
        CHECK(torch::equal(item.value(), again.model->named_parameters()[item.key()]));
    }
}

TEST_CASE("float16 files hold the nearest values and half the bytes")
{
    const ScratchFolder folder;
    const Network network({}, 9);
    save(network, {}, folder.path("m.safetensors"), "F32");
    save(network, {}, folder.path("h.safetensors"), "F16");
    const LoadedModel half = loaded(folder.path("h.safetensors"));
    for (const auto& item : network.named_parameters()) {
        INFO(item.key());
        CHECK(torch::equal(item.value().to(torch::kHalf).to(torch::kFloat32),
                           half.model->named_parameters()[item.key()]));
    }
    CHECK(contents(folder.path("h.safetensors")).size() < 0.52 * contents(folder.path("m.safetensors")).size());
}

TEST_CASE("every ablation with the pipeline's own blocks becomes a model file that computes the same")
{
    const torch::NoGradGuard no_gradient;
    const ScratchFolder folder;
    const std::string path = folder.path("m.safetensors");
    const torch::Tensor source = smooth_images(2, 32, 32, 1), reference = smooth_images(2, 32, 32, 2, 0, 0.4);
    for (const ModelSettings& settings : ablations()) {
        REQUIRE(is_srisp_model(settings));
        Network network(settings, 3);
        for (const auto& item : network.named_parameters())
            if (item.key().find("head") != std::string::npos) // fixed selections start even
                item.value().add_(torch::linspace(0, 0.5, item.value().size(0))
                                      .view_as(item.value().dim() == 1 ? item.value() : item.value().slice(1, 0, 1)));
        save(network, settings, path, "F32");
        CHECK(parse_model(contents(path), "model"));
        ChosenParameters expected, actual;
        const torch::Tensor raw = network.reverse(source, reference, &expected);
        const LoadedModel again = loaded(path);
        const Difference difference =
            compare(values_of(again.model->reverse(source, reference, &actual)), values_of(raw));
        INFO(difference.text);
        CHECK(difference.largest < 1e-6);
        CHECK(compare(values_of(actual.color), values_of(expected.color)).largest < 1e-6);
    }
}

TEST_CASE("what no tool can run is saved too, and only the trainer reads it")
{
    const torch::NoGradGuard no_gradient;
    const ScratchFolder folder;
    const std::string path = folder.path("m.safetensors");
    ModelSettings unet, merged, mbispld;
    unet.method = "unet";
    unet.unet_channels = 4;
    merged.gain = "merged";
    mbispld.method = "mbispld";
    const torch::Tensor source = smooth_images(2, 32, 32, 1), reference = smooth_images(2, 32, 32, 2, 0, 0.4);
    for (const ModelSettings& settings : { unet, merged, mbispld }) {
        INFO(settings.method);
        REQUIRE(!is_srisp_model(settings));
        const auto model = make_unprocessor(settings, 3);
        save(*model, settings, path, "F32");
        CHECK(torch::equal(model->reverse(source, reference), loaded(path).model->reverse(source, reference)));
        Expected<std::unique_ptr<ModelData>> refused = parse_model(contents(path), "model");
        REQUIRE(!refused);
        CHECK(refused.error().message ==
              "model: metadata 'format' is 'srisp-baseline-1', must be 'srisp-1' or 'srisp-7'");
    }
}

TEST_CASE("model files say what is wrong with them")
{
    const ScratchFolder folder;
    const std::string path = folder.path("m.safetensors");
    CHECK(failure(path).find("model '" + path + "': cannot open") == 0);
    ModelFile file = random_model(3, 1);
    file.tensors.erase("fuse.weight");
    file.write(path);
    CHECK(failure(path) == "model '" + path + "': has no tensor 'fuse.weight'");
    file.metadata["format"] = "srisp-baseline-1";
    file.write(path);
    CHECK(failure(path) == "model '" + path + "': metadata 'settings' is missing or no JSON object");
    file.metadata["settings"] = R"({"method": "unet"})";
    file.write(path);
    CHECK(failure(path).find("model '" + path + "': has ") == 0);
}

TEST_CASE("a model without licence, or with values that are no numbers or too large, is not written")
{
    const ScratchFolder folder;
    const std::string path = folder.path("m.safetensors");
    Network network({}, 1);
    CHECK(save_model(network, {}, path, { { "train_data", "none" } }).error().message ==
          "model '" + path + "': metadata 'license' is missing");
    const torch::NoGradGuard no_gradient;
    network.named_parameters()["fuse.bias"][3] = 1e6;
    CHECK(save_model(network, {}, path, kMetadata));
    CHECK(save_model(network, {}, path, kMetadata, "F16").error().message ==
          "model '" + path + "': tensor 'fuse.bias' has 1000000.000000 at element 3, largest float16 is 65504");
    std::filesystem::remove(path);
    network.named_parameters()["fuse.bias"][3] = std::nan("");
    CHECK(save_model(network, {}, path, kMetadata).error().message ==
          "model '" + path + "': tensor 'fuse.bias' has nan at element 3");
    CHECK(!std::filesystem::exists(path));
}
