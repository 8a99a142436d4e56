// SPDX-License-Identifier: Apache-2.0
#include <srisp/model.h>

#include <cmath>
#include <cstdlib>

#include <doctest/doctest.h>

#include "model/model_data.h"
#include "random_model.h"
#include "shared_files.h"

using namespace srisp;

namespace {

std::string message(const std::string& name)
{
    Expected<std::shared_ptr<const Model>> model = Model::load(name);
    return model ? "no error" : model.error().message;
}

/// What the loader says of a good model after `change`; "model 'PATH': " is cut off.
template<class Change> std::string message_after(Change change)
{
    const ScratchFolder folder;
    ModelFile file = random_model(3, 1);
    change(file);
    const std::string path = file.write(folder.path("m.safetensors")), prefix = "model '" + path + "': ";
    const std::string text = message(path);
    return text.rfind(prefix, 0) == 0 ? text.substr(prefix.size()) : text;
}

} // namespace

TEST_CASE("the models that ship load by name and say what they are")
{
    Expected<std::shared_ptr<const Model>> shipped = Model::load("default"), spatial = Model::load("spatial");
    REQUIRE_MESSAGE(shipped, (shipped ? "" : shipped.error().message));
    REQUIRE_MESSAGE(spatial, (spatial ? "" : spatial.error().message));
    CHECK((*shipped)->name() == "default");
    CHECK((*shipped)->kernel_size() == 1);
    CHECK((*spatial)->kernel_size() == 3);
    CHECK((*shipped)->dictionary_size() == 5);
    CHECK((*shipped)->hash().size() == 7 + 32);
    CHECK((*shipped)->hash() != (*spatial)->hash());
    CHECK((*shipped)->metadata().at("license") == "Apache-2.0");
    const std::vector<std::string> names = Model::available();
    CHECK(names == std::vector<std::string>{ "default", "spatial" });
}

TEST_CASE("float16 and bfloat16 models load, with another dictionary size too")
{
    const ScratchFolder folder;
    for (const char* type : { "F32", "F16", "BF16" }) {
        ModelFile file = random_model(1, 2, 7);
        file.type = type;
        Expected<std::shared_ptr<const Model>> model =
            Model::load(file.write(folder.path(std::string(type) + ".safetensors")));
        REQUIRE_MESSAGE(model, (model ? "" : model.error().message));
        CHECK((*model)->dictionary_size() == 7);
        CHECK((*model)->name() == type);
        CHECK(model_data(**model).gain_atoms[3] ==
              doctest::Approx(file.tensors["dictionary.gain"].values[3]).epsilon(0.01));
    }
}

TEST_CASE("SRISP_MODEL_PATH comes before the models beside the library")
{
    const ScratchFolder folder;
    random_model(3, 9).write(folder.path("default.safetensors"));
    random_model(3, 9).write(folder.path("mine.safetensors"));
    setenv("SRISP_MODEL_PATH", ("/no/such/folder:" + folder.path(".")).c_str(), 1);
    Expected<std::shared_ptr<const Model>> model = Model::load("default");
    const std::vector<std::string> names = Model::available();
    unsetenv("SRISP_MODEL_PATH");
    REQUIRE(model);
    CHECK((*model)->path() == folder.path("./default.safetensors"));
    CHECK(names == std::vector<std::string>{ "default", "mine", "spatial" });
}

TEST_CASE("an unknown model name lists the near ones")
{
    CHECK(message("defualt").find("unknown model 'defualt'; did you mean 'default'? (looked in ") == 0);
    CHECK(message("x").find("unknown model 'x'; known: default, spatial (looked in ") == 0);
    CHECK(message("") == "model name is empty");
    CHECK(message("/no/such/model.safetensors") ==
          "model '/no/such/model.safetensors': cannot open '/no/such/model.safetensors': No such file or directory");
}

TEST_CASE("a model that is cut short anywhere is refused")
{
    const ScratchFolder folder;
    const std::string bytes = random_model(1, 3).bytes();
    for (const std::size_t length :
         { std::size_t(0), std::size_t(7), std::size_t(100), bytes.size() / 2, bytes.size() - 1 }) {
        write_file(folder.path("cut.safetensors"), bytes.substr(0, length));
        INFO(length, " of ", bytes.size(), " bytes: ", message(folder.path("cut.safetensors")));
        CHECK(message(folder.path("cut.safetensors")).rfind("model '" + folder.path("cut.safetensors") + "': ", 0) ==
              0);
    }
}

TEST_CASE("wrong metadata is refused with the value and what is allowed")
{
    const auto with = [](const std::string& key, const std::string& value) {
        return message_after([&](ModelFile& file) { file.metadata[key] = value; });
    };
    CHECK(with("format", "srisp-9") == "metadata 'format' is 'srisp-9', must be 'srisp-1' or 'srisp-7'");
    CHECK(with("kernel_size", "5") == "metadata 'kernel_size' is '5', must be '3' or '1'");
    CHECK(with("dictionary_size", "0") == "metadata 'dictionary_size' is '0', must be 1 … 64");
    CHECK(with("dictionary_size", "99999999999") == "metadata 'dictionary_size' is '99999999999', must be 1 … 64");
    CHECK(with("encoder_input", "x") == "metadata 'encoder_input' is 'x', must be 'perceptual' or 'plain'");
    CHECK(with("statistics", "0") == "metadata 'anchor' is 1 but 'statistics' is 0; the anchor needs the statistics");
    CHECK(with("dictionary_size", "4") == "tensor 'tone.head.0.weight' has shape [5, 32], needs [4, 32]");
    CHECK(with("kernel_size", "1") ==
          "tensor 'dictionary.tone_reverse.0.weight' has shape [5, 32, 3, 3, 3], needs [5, 32, 3, 1, 1]");
    CHECK(message_after([](ModelFile& file) { file.metadata.erase("license"); }) == "metadata 'license' is missing");
}

TEST_CASE("missing, unknown, misshapen, NaN and degenerate tensors are refused by name")
{
    CHECK(message_after([](ModelFile& file) { file.tensors.erase("fuse.weight"); }) == "has no tensor 'fuse.weight'");
    CHECK(message_after([](ModelFile& file) {
              file.tensors["fuse.wieght"] = { { 1 }, { 0 } };
          }).rfind("unknown tensor 'fuse.wieght'; did you mean 'fuse.weight'", 0) == 0);
    CHECK(message_after([](ModelFile& file) {
              file.tensors["fuse.bias"].shape = { 64, 2 };
          }) == "tensor 'fuse.bias' has shape [64, 2], needs [128]");
    CHECK(message_after([](ModelFile& file) { file.tensors["anchor.bias"].values[2] = NAN; }) ==
          "tensor 'anchor.bias' has nan at element 2");
    CHECK(message_after([](ModelFile& file) { file.tensors["dictionary.gamma"].values[0] = -1; }) ==
          "tensor 'dictionary.gamma' has -1.000000, must be > 0");
    CHECK(message_after([](ModelFile& file) {
              file.tensors["dictionary.color"].values = std::vector<float>(45, 0.3f);
          }) == "tensor 'dictionary.color': atom 0 is singular, its matrix is degenerate");
    CHECK(message_after([](ModelFile& file) {
              for (int i = 9; i < 12; ++i)
                  file.tensors["dictionary.color"].values[i] = i == 9 ? 1.0f : -0.5f;
          }) == "tensor 'dictionary.color': row 0 of atom 1 sums to 0, its matrix is degenerate");
}

TEST_CASE("the golden models load")
{
    for (const char* name : { "golden/model_spatial.safetensors", "golden/model_pointwise.safetensors",
                              "golden/model_paper.safetensors" }) {
        SKIP_WITHOUT_SHARED(name);
        CHECK(message(shared_file(name)) == "no error");
    }
}
