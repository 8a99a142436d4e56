// SPDX-License-Identifier: Apache-2.0
#include "train/evaluation/developed_images.h"

#include <doctest/doctest.h>

#include "model/safetensors.h"
#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::train;

namespace {

/// A file of two images of 2 x 4 pixels; RAW values are 0.25 and photos 0.5 where nothing else is asked for.
struct DevelopedFile {
    std::map<std::string, std::string> metadata{ { "format", "srisp-developed-1" },
                                                 { "cameras", R"(["Maker A","Maker B"])" } };
    std::vector<std::int64_t> shape{ 2, 3, 2, 4 }, photo_shape{ 2, 3, 2, 4 };
    float photo_value = 0.5f;
    std::string photo_name = "photo:dcraw";

    std::string read_error(const std::string& path) const
    {
        const Expected<DevelopedImages> images = read(path);
        return images ? "no error" : images.error().message.substr(("developed images '" + path + "': ").size());
    }

    Expected<DevelopedImages> read(const std::string& path) const
    {
        std::vector<float> raw(48, 0.25f), photo(48, photo_value);
        REQUIRE(write_safetensors(
            path, { { "raw", "F32", shape, raw.data() }, { photo_name, "F32", photo_shape, photo.data() } }, metadata));
        return read_developed_images(path);
    }
};

} // namespace

TEST_CASE("developed images come by converter, with the camera of each")
{
    const ScratchFolder folder;
    const Expected<DevelopedImages> images = DevelopedFile().read(folder.path("d.safetensors"));
    REQUIRE_MESSAGE(images, (images ? "" : images.error().message));
    CHECK(images->scenes.cameras == std::vector<std::string>{ "Maker A", "Maker B" });
    CHECK(images->scenes.camera == std::vector<int>{ 0, 1 });
    CHECK(images->scenes.raw.sizes() == at::IntArrayRef({ 2, 3, 2, 4 }));
    CHECK(images->scenes.raw.eq(0.25).all().item<bool>());
    REQUIRE(images->photos.size() == 1);
    CHECK(images->photos[0].first == "dcraw");
    CHECK(images->photos[0].second.eq(0.5).all().item<bool>());
}

TEST_CASE("a file of developed images that does not fit together is refused, and the message says what is wrong")
{
    const ScratchFolder folder;
    const std::string path = folder.path("d.safetensors");
    DevelopedFile file;
    file.metadata["format"] = "else";
    CHECK(file.read_error(path) == "metadata 'format' must be 'srisp-developed-1'");
    file = {};
    file.metadata["cameras"] = R"(["Maker A"])";
    CHECK(file.read_error(path) == "metadata 'cameras' has 1 names, needs 2, one for each image");
    file = {};
    file.photo_shape = { 2, 3, 4, 2 };
    CHECK(file.read_error(path) == "tensor 'photo:dcraw' has shape [2, 3, 4, 2], needs [2, 3, 2, 4], that of 'raw'");
    file = {};
    file.shape = file.photo_shape = { 2, 4, 3, 2 };
    CHECK(file.read_error(path) == "tensor 'raw' has shape [2, 4, 3, 2], needs [N, 3, height, width]");
    file = {};
    file.photo_value = 1.5f;
    CHECK(file.read_error(path) == "tensor 'photo:dcraw' has values outside 0 … 1");
    file = {};
    file.photo_name = "picture";
    CHECK(file.read_error(path) == "unknown tensor 'picture'");
    CHECK(read_developed_images(folder.path("none")).error().message.find("none") != std::string::npos);
}
