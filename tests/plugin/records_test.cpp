// SPDX-License-Identifier: Apache-2.0
// What images say of how they were made is a stranger's word.
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>

#include <srisp/metadata.h>

#include "test_images.h"

using namespace srisp;
using namespace srisp::plugin;

TEST_CASE("a photo whose caption holds a deeply nested record is a photo like others")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), path = folder.path("nested.png");
    for (const std::string& caption :
         { "{\"srisp\":" + std::string(100000, '['),
           "{\"srisp\":\"\",\"parameters\":" + std::string(100000, '[') + std::string(100000, ']') + "}" }) {
        OIIO::ImageSpec spec(9, 7, 3, OIIO::TypeUInt8);
        spec.attribute("ImageDescription", caption);
        write_image(path, spec, test_pixels(9, 7, 3));
        SrispInput input;
        CHECK(bool(recorded_parameters(open_ours(input, path + ".srisp?reference=" + reference), "raw")));
        CHECK(has(refusal_of(path + ".srisp?direction=forward"), "records no parameters"));
    }
}

TEST_CASE("the model that an image records is found by name and hash, and is never a path")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = write_photo(folder), raw = folder.path("raw.exr");
    const std::string mine = folder.path("mine.safetensors");
    std::filesystem::copy_file(std::string(SRISP_SOURCE_DIR) + "/configs/models/default.safetensors", mine);
    {
        SrispInput input;
        const OIIO::ImageSpec spec = open_ours(input, photo + ".srisp?model=" + mine + "&reference=" + reference);
        write_image(raw, spec, read_all(input));
    }
    const std::string forward = ".srisp?direction=forward";
    const std::string unknown = refusal_of(raw + forward);
    CHECK(has(unknown, "parameters were chosen with model 'mine' (xxh128:"));
    CHECK(has(unknown, "), which is not among the models known here (looked in "));
    CHECK(has(unknown, "; model=FILE gives it"));
    OIIO::ImageSpec given, found;
    const std::vector<float> pixels = result_of(raw + forward + "&model=" + mine, given);
    const ScratchFolder other; // another model of that name comes first, then a broken one
    std::filesystem::copy_file(std::string(SRISP_SOURCE_DIR) + "/configs/models/spatial.safetensors",
                               other.path("mine.safetensors"));
    const ScratchFolder broken;
    broken.file("mine.safetensors", "no model");
    ::setenv("SRISP_MODEL_PATH", other.path().c_str(), 1);
    CHECK(has(refusal_of(raw + forward), "but '" + other.path("mine.safetensors") + "' is xxh128:"));
    ::setenv("SRISP_MODEL_PATH", (other.path() + ":" + broken.path() + ":" + folder.path()).c_str(), 1);
    CHECK(result_of(raw + forward, found) == pixels);
    ::unsetenv("SRISP_MODEL_PATH");

    const std::string secret = folder.file("secret", "12345678 and more"), fifo = folder.path("fifo");
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    SrispInput input;
    OIIO::ImageSpec spec = open_ours(input, photo + ".srisp?reference=" + reference);
    Parameters parameters = *recorded_parameters(spec, "raw");
    for (const std::string& name : { secret, fifo, mine, std::string("mine.safetensors"), std::string("../x"),
                                     std::string("a\0b", 3), std::string(100000, 'x'), std::string() }) {
        parameters.model_name = name;
        record_result(spec, parameters, nullptr, Direction::reverse);
        write_image(raw, spec, test_pixels(spec.width, spec.height, 3));
        const std::string told = refusal_of(raw + forward);
        CHECK_MESSAGE(has(told, "which is not among the models known here"), told);
        CHECK(told.size() < 1000);
        folder.file("p.json", to_json(parameters));
        if (!name.empty())
            CHECK(has(refusal_of(photo + ".srisp?params=" + folder.path("p.json")), "not among the models known here"));
    }
}
