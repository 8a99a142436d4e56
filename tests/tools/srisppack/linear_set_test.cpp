// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisppack/linear_set.h"

#include <cmath>
#include <filesystem>

#include <doctest/doctest.h>

#include "base/half_float.h"
#include "model/safetensors.h"
#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

/// A set of three images of 40 × 32 pixels, of values in [0.25, 0.75]; the tests damage it.
struct Set {
    std::vector<std::uint16_t> raw;
    std::vector<float> illuminant = { 0.5f, 1, 0.25f, 0.5f, 1, 0.25f, 0, 1, 1 };
    std::vector<std::uint8_t> validation = { 0, 1, 0 };
    std::map<std::string, std::string> metadata = { { "format", "srisp-thumbnails-1" },
                                                    { "camera", "Nikon D5200" },
                                                    { "dataset", "NUS" },
                                                    { "names", "NikonD5200_1 NikonD40_2 NikonD5200_3" } };
    ScratchFolder scratch;

    Set()
    {
        for (int i = 0; i < 3 * 32 * 40 * 3; ++i)
            raw.push_back(half_from_float(0.25f + float(i % 100) / 200));
    }
    std::vector<PackTask> tasks() const
    {
        const std::string path = scratch.path("set.safetensors");
        REQUIRE(write_safetensors(path,
                                  { { "raw", "F16", { 3, 32, 40, 3 }, raw.data() },
                                    { "illuminant", "F32", { 3, 3 }, illuminant.data() },
                                    { "validation", "U8", { 3 }, validation.data() } },
                                  metadata));
        return linear_set_tasks(path, "set.safetensors", {}, { 32, 3, 0 });
    }
    std::string message(std::size_t task = 0) const
    {
        const auto packed = tasks().at(task).run();
        return packed ? "no error" : packed.error().message.substr(packed.error().message.find("': ") + 3);
    }
};

} // namespace

TEST_CASE("a set of linear images gives a task per image, with camera, light and validation")
{
    const Set set;
    const std::vector<PackTask> tasks = set.tasks();
    REQUIRE(tasks.size() == 3);
    const auto first = tasks[0].run(), second = tasks[1].run(), third = tasks[2].run();
    REQUIRE((first && second && third));
    const PackEntry& image = first->scene.common;
    CHECK(image.name == "set.safetensors/NikonD5200_1");
    CHECK(image.group == "Nikon D5200");
    CHECK(image.source == "NUS");
    CHECK(image.licence == "not stated");
    CHECK_FALSE(image.open);
    CHECK(image.white_balance == std::array<float, 3>{ 2, 1, 4 });
    CHECK(second->scene.common.group == "Nikon D40");
    CHECK(second->scene.common.validation);
    CHECK(third->scene.common.white_balance[1] == 0);
    // 40 pixels to 32: the first cell holds one and a quarter of a pixel.
    const double expected = (0.25 + 0.265 * 0.25) / 1.25;
    CHECK(first->pixels.size() == 3 * 32 * 32);
    CHECK(std::abs(first->pixels[0] / 65535.0 - expected) < 1e-4);
    CHECK(linear_set_size(set.scratch.path("set.safetensors")) == 32);
}

TEST_CASE("the masked part of an image is cut away, and an image that is mostly masked is left out")
{
    Set set;
    for (int y = 0; y < 32; ++y)
        for (int i = 30 * 3; i < 40 * 3; ++i)
            set.raw[std::size_t(y * 40 * 3 + i)] = 0;
    for (std::size_t i = 32 * 40 * 3; i < 32 * 40 * 3 * 7 / 4; ++i)
        set.raw[i] = 0;
    const auto first = set.tasks()[0].run(), second = set.tasks()[1].run();
    REQUIRE((first && second));
    CHECK(first->scene.crops[0] == std::array<float, 4>{ 0, 0, 0.75f, 1 });
    CHECK(first->enlarged);
    CHECK(second->left_out == "less than half of the image is not masked with zeros");
}

TEST_CASE("sets that are damaged or of another kind are refused")
{
    Set format, camera, names, nan;
    format.metadata["format"] = "other";
    CHECK(format.message() == "format is 'other', must be 'srisp-thumbnails-1'");
    camera.metadata.erase("camera");
    CHECK(camera.message() == "metadata 'camera' is missing");
    names.metadata["names"] = "a b";
    CHECK(names.message() == "metadata 'names' has 2 words, the set has 3 images");
    nan.raw[32 * 40 * 3 + 5] = half_from_float(NAN);
    CHECK(nan.message(0) == "no error");
    CHECK(nan.message(1) == "image 1 holds NaN or infinity");

    const ScratchFolder scratch;
    const auto message = [&](const std::string& path) {
        const auto packed = linear_set_tasks(path, "x", {}, {}).at(0).run();
        return packed ? "no error" : packed.error().message;
    };
    CHECK(message(scratch.path("no")) ==
          "set '" + scratch.path("no") + "' cannot be opened: No such file or directory");
    const std::string path = scratch.path("small.safetensors");
    const std::vector<float> values(31 * 40 * 3);
    REQUIRE(write_safetensors(path, { { "raw", "F32", { 1, 31, 40, 3 }, values.data() } }, Set().metadata));
    CHECK(message(path) ==
          "set '" + path +
              "': tensor 'raw' is F32 [1, 31, 40, 3], must be F16 or F32 [N, height, width, 3] with 32 "
              "to 1024 pixels a side");
}

TEST_CASE("a set that is made shorter while it is packed is an error for each image that is gone")
{
    const Set set;
    const std::string path = set.scratch.path("set.safetensors");
    const std::vector<PackTask> tasks = set.tasks();
    const auto size = std::filesystem::file_size(path);
    const auto image = std::uintmax_t(2 * 40 * 32 * 3);
    std::filesystem::resize_file(path, size - image);
    CHECK(tasks[0].run());
    const auto cut = tasks[2].run();
    REQUIRE_FALSE(cut);
    CHECK(cut.error().message.find("set '" + path + "' was made shorter while it was read: it had ") == 0);
    std::filesystem::resize_file(path, 0);
    CHECK_FALSE(tasks[0].run());
}
