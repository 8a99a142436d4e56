// SPDX-License-Identifier: Apache-2.0
#include "hand_over.h"

#include <fstream>

#include <sys/stat.h>

#include <srisp/metadata.h>

#include "srisp_output.h"
#include "test_images.h"

using namespace srisp;
using namespace srisp::plugin;

namespace {

std::string job_file(const ScratchFolder& folder, const std::string& name, const std::string& rest)
{
    return folder.file(name, "{\"format\": \"srisp-recipe-1\"" + rest + "}");
}

void write_ours(const std::string& path, const OIIO::ImageSpec& spec, const std::vector<float>& pixels)
{
    SrispOutput output;
    REQUIRE_MESSAGE(output.open(path, spec, OIIO::ImageOutput::Create), output.geterror());
    REQUIRE(output.write_image(OIIO::TypeFloat, pixels.data()));
    REQUIRE_MESSAGE(output.close(), output.geterror());
}

OIIO::ImageSpec photo_spec()
{
    OIIO::ImageSpec spec(50, 40, 3, OIIO::TypeFloat);
    spec.attribute("oiio:ColorSpace", "sRGB");
    return spec;
}

std::string text_of(const std::string& path)
{
    std::ifstream file(path);
    return { std::istreambuf_iterator<char>(file), {} };
}

} // namespace

TEST_CASE("a stub's name tells job and frame, also while a host writes it under another")
{
    for (const char* path : { "/t/3.0007.srisp", "/t/3.0007.12ab34cd.temp.srisp" }) {
        CHECK(parse_stub_name(path).job == "/t/3.json");
        CHECK(parse_stub_name(path).frame == "0007");
    }
    CHECK(parse_stub_name("/t/3.srisp").job == "/t/3.json");
    CHECK(parse_stub_name("/t/3.srisp").frame.empty());
}

TEST_CASE("what is handed over comes back as the file itself would")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = write_photo(folder);
    job_file(folder, "1.json", ", \"reference\": \"reference.exr\"");
    auto file = OIIO::ImageInput::open(photo);
    OIIO::ImageSpec spec = file->spec();
    const auto pixels = read_all(*file);
    write_ours(folder.path("1.0001.srisp"), spec, pixels);

    SrispInput direct, handed;
    open_ours(direct, photo + ".srisp?reference=" + reference);
    const OIIO::ImageSpec result = open_ours(handed, folder.path("1.0001.srisp"));
    CHECK(read_all(handed) == read_all(direct));
    CHECK(bool(recorded_parameters(result, "handed")));
}

TEST_CASE("a later frame of a job frees the one before")
{
    const ScratchFolder folder;
    write_reference(folder);
    job_file(folder, "1.json", ", \"reference\": \"reference.exr\"");
    write_ours(folder.path("1.0001.srisp"), photo_spec(), test_pixels(50, 40, 3));
    write_ours(folder.path("1.0002.srisp"), photo_spec(), test_pixels(50, 40, 3));
    SrispInput second;
    open_ours(second, folder.path("1.0002.srisp"));
    CHECK(has(refusal_of(folder.path("1.0001.srisp")), "memory of another process"));
}

TEST_CASE("subimages and MIP levels are handed over")
{
    const ScratchFolder folder;
    write_reference(folder);
    job_file(folder, "1.json", ", \"reference\": \"reference.exr\"");
    const std::string path = folder.path("1.0.srisp");
    SrispOutput output;
    OIIO::ImageSpec small = photo_spec();
    small.width = 25;
    small.height = 20;
    REQUIRE(output.open(path, photo_spec(), OIIO::ImageOutput::Create));
    REQUIRE(output.write_image(OIIO::TypeFloat, test_pixels(50, 40, 3).data()));
    REQUIRE(output.open(path, small, OIIO::ImageOutput::AppendMIPLevel));
    REQUIRE(output.write_image(OIIO::TypeFloat, test_pixels(25, 20, 3).data()));
    REQUIRE(output.open(path, small, OIIO::ImageOutput::AppendSubimage));
    REQUIRE(output.write_image(OIIO::TypeFloat, test_pixels(25, 20, 3).data()));
    REQUIRE(output.close());
    SrispInput input;
    open_ours(input, path);
    CHECK(input.spec(0, 1).width == 25);
    CHECK(input.spec(1, 0).width == 25);
    CHECK(!input.seek_subimage(1, 1));
    CHECK(read_all(input, 1).size() == 25u * 20 * 3);
}

TEST_CASE("tiles are taken as well as scanlines")
{
    const ScratchFolder folder;
    write_reference(folder);
    job_file(folder, "1.json", ", \"reference\": \"reference.exr\"");
    OIIO::ImageSpec tiled = photo_spec();
    tiled.tile_width = tiled.tile_height = 16;
    write_ours(folder.path("1.1.srisp"), photo_spec(), test_pixels(50, 40, 3));
    SrispInput input;
    open_ours(input, folder.path("1.1.srisp"));
    const auto by_rows = read_all(input);
    write_ours(folder.path("1.2.srisp"), tiled, test_pixels(50, 40, 3));
    SrispInput other;
    CHECK(open_ours(other, folder.path("1.2.srisp")).tile_width == 16);
    CHECK(read_all(other) == by_rows);
}

TEST_CASE("hold keeps the parameters of the first frame")
{
    const ScratchFolder folder;
    write_reference(folder);
    const auto parameters_of = [&](const std::string& job, const std::string& frame, float high) {
        write_ours(folder.path(job + "." + frame + ".srisp"), photo_spec(), test_pixels(50, 40, 3, 0.05f, high));
        SrispInput input;
        return to_json(*recorded_parameters(open_ours(input, folder.path(job + "." + frame + ".srisp")), "frame"));
    };
    job_file(folder, "1.json", ", \"reference\": \"reference.exr\", \"hold\": true");
    job_file(folder, "2.json", ", \"reference\": \"reference.exr\"");
    const std::string first = parameters_of("1", "1", 0.9f);
    CHECK(parameters_of("1", "2", 0.4f) == first);
    CHECK(parameters_of("2", "1", 0.9f) == first);
    CHECK(parameters_of("2", "2", 0.4f) != first);
}

TEST_CASE("save writes the recorded parameters, with the frame's number")
{
    const ScratchFolder folder;
    write_reference(folder);
    job_file(folder, "1.json", ", \"reference\": \"reference.exr\"");
    write_ours(folder.path("1.0012.srisp"), photo_spec(), test_pixels(50, 40, 3));
    SrispInput input;
    const OIIO::ImageSpec result = open_ours(input, folder.path("1.0012.srisp"));
    job_file(folder, "2.json", ", \"action\": \"save\", \"file\": \"" + folder.path("p.####.json") + "\"");
    write_ours(folder.path("2.0012.srisp"), result, read_all(input));
    CHECK(text_of(folder.path("p.0012.json")) == to_json(*recorded_parameters(result, "x")) + "\n");

    SrispOutput output;
    REQUIRE(output.open(folder.path("2.0013.srisp"), photo_spec(), OIIO::ImageOutput::Create));
    CHECK(!output.close());
    CHECK(has(output.geterror(), "frame 0013: holds no recorded parameters"));
    CHECK(!std::filesystem::exists(folder.path("p.0013.json")));
}

TEST_CASE("only names that belong to a job are written")
{
    const ScratchFolder folder;
    SrispOutput output;
    CHECK(!output.open(folder.path("picture.srisp"), photo_spec(), OIIO::ImageOutput::Create));
    CHECK(has(output.geterror(), "srisp files hold no pixels; write EXR or TIFF"));
    CHECK(!std::filesystem::exists(folder.path("picture.srisp")));
    job_file(folder, "1.json", ", \"reference\": \"reference.exr\"");
    OIIO::ImageSpec deep = photo_spec();
    deep.deep = true;
    CHECK(!output.open(folder.path("1.1.srisp"), deep, OIIO::ImageOutput::Create));
    CHECK(has(output.geterror(), "deep"));
}

TEST_CASE("a job in a folder that others can write to is no job")
{
    const ScratchFolder folder;
    job_file(folder, "1.json", ", \"action\": \"save\", \"file\": \"" + folder.path("victim.txt") + "\"");
    REQUIRE(::chmod(folder.path().c_str(), 0755) == 0);
    SrispOutput output;
    CHECK(!output.open(folder.path("1.srisp"), photo_spec(), OIIO::ImageOutput::Create));
    CHECK(has(output.geterror(), "does not lie in a folder that srisptool made for itself"));
    REQUIRE(::chmod(folder.path().c_str(), 0700) == 0);
    CHECK(output.open(folder.path("1.srisp"), photo_spec(), OIIO::ImageOutput::Create));
    CHECK(output.geterror() == "");
}

TEST_CASE("a text is a stub, or none")
{
    CHECK(parse_stub(stub_text("12-3")).value() == "12-3");
    CHECK(parse_stub("{\"format\": \"srisp-slot-1\"}").value().empty());
    CHECK(!parse_stub("{\"format\": \"srisp-recipe-1\"}"));
    CHECK(!parse_stub("no JSON"));
}

TEST_CASE("a stub whose image is gone says so")
{
    const ScratchFolder folder;
    job_file(folder, "1.json", ", \"reference\": \"reference.exr\"");
    const std::string stub = folder.file("1.7.srisp", stub_text("999-1"));
    CHECK(has(refusal_of(stub), "was in the memory of another process"));
}
