// SPDX-License-Identifier: Apache-2.0
#include <srisp/srisp.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <doctest/doctest.h>

#include "random_model.h"
#include "scratch_folder.h"

using namespace srisp;

namespace {

const std::string kSample = std::string(SRISP_SOURCE_DIR) + "/configs/sample/";
const std::string kPhoto = kSample + "photo.jpg", kReference = kSample + "reference.dng";

std::string refusal(const Expected<Image>& result)
{
    REQUIRE(!result);
    return result.error().message;
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

std::vector<float> pixels_of(const std::string& path, OIIO::TypeDesc& type)
{
    const auto input = OIIO::ImageInput::open(path);
    REQUIRE(input);
    const OIIO::ImageSpec spec = input->spec();
    type = spec.format;
    std::vector<float> pixels(std::size_t(spec.width) * spec.height * spec.nchannels);
    REQUIRE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, pixels.data()));
    return pixels;
}

} // namespace

TEST_CASE("one call leads from files to pixels, and one back")
{
    const auto raw = unprocess(kPhoto, kReference);
    REQUIRE_MESSAGE(raw, (raw ? "" : raw.error().message));
    const OIIO::ImageSpec& spec = raw->spec();
    CHECK(raw->pixels().size() == std::size_t(spec.width) * spec.height * 3);
    CHECK(raw->view().pixel(1, 2) == raw->pixels().data() + (std::size_t(2) * spec.width + 1) * 3);
    CHECK(spec.get_string_attribute("oiio:ColorSpace") == "camera_rgb");
    const auto parameters = recorded_parameters(spec, "raw");
    REQUIRE_MESSAGE(parameters, (parameters ? "" : parameters.error().message));
    CHECK(parameters->reference_name == "reference.dng");

    const ScratchFolder folder;
    REQUIRE(raw->save(folder.path("raw.tif")));
    OIIO::TypeDesc type;
    CHECK(pixels_of(folder.path("raw.tif"), type) == raw->pixels());
    CHECK(type == OIIO::TypeFloat);
    const auto photo = process(folder.path("raw.tif"));
    REQUIRE_MESSAGE(photo, (photo ? "" : photo.error().message));
    CHECK(photo->spec().get_string_attribute("oiio:ColorSpace") == "sRGB");
    std::vector<float> original = pixels_of(kPhoto, type);
    REQUIRE(original.size() == photo->pixels().size());
    double sum = 0;
    for (std::size_t i = 0; i < original.size(); ++i)
        sum += std::abs(original[i] - photo->pixels()[i]);
    CHECK(sum / double(original.size()) < 0.05);

    Options given;
    given.parameters = *parameters;
    const auto replayed = unprocess(kPhoto, "", given);
    REQUIRE_MESSAGE(replayed, (replayed ? "" : replayed.error().message));
    CHECK(replayed->pixels() == raw->pixels());
}

TEST_CASE("a brightness makes the RAW-like image brighter, is recorded, and the way back gives the photo")
{
    const auto plain = unprocess(kPhoto, kReference);
    REQUIRE_MESSAGE(plain, (plain ? "" : plain.error().message));
    const auto chosen = recorded_parameters(plain->spec(), "raw");
    REQUIRE(chosen);
    Options options;
    options.brightness = Brightness{ -1, false };
    const auto darker = unprocess(kPhoto, kReference, options);
    REQUIRE_MESSAGE(darker, (darker ? "" : darker.error().message));
    const auto recorded = recorded_parameters(darker->spec(), "raw");
    REQUIRE(recorded);
    CHECK(recorded->gain == 2 * chosen->gain);
    CHECK(recorded->brightness_ev == -1);
    CHECK(recorded->brightness_sd_ev == chosen->brightness_sd_ev);
    double sums[2] = {};
    for (std::size_t i = 0; i < plain->pixels().size(); ++i) {
        sums[0] += plain->pixels()[i];
        sums[1] += darker->pixels()[i];
    }
    CHECK(sums[1] / sums[0] == doctest::Approx(0.5).epsilon(0.05)); // highlights stay

    const ScratchFolder folder;
    REQUIRE(plain->save(folder.path("plain.tif")));
    REQUIRE(darker->save(folder.path("darker.tif")));
    const auto back = process(folder.path("plain.tif")), back_of_darker = process(folder.path("darker.tif"));
    REQUIRE(back);
    REQUIRE(back_of_darker);
    double difference = 0;
    for (std::size_t i = 0; i < back->pixels().size(); ++i)
        difference += std::abs(back->pixels()[i] - back_of_darker->pixels()[i]);
    CHECK(difference / double(back->pixels().size()) < 2e-3);

    options.parameters = *chosen;
    const auto replayed = unprocess(kPhoto, "", options);
    REQUIRE_MESSAGE(replayed, (replayed ? "" : replayed.error().message));
    CHECK(replayed->pixels() == darker->pixels());
    options.parameters = *recorded;
    options.brightness = Brightness{ 1, false };
    CHECK(unprocess(kPhoto, "", options)->pixels() == plain->pixels());
    CHECK(has(refusal(process(folder.path("plain.tif"), options)), "brightness is for photos that become RAW-like"));
}

TEST_CASE("a sampled brightness is the same for the same photo and seed, and needs a deviation")
{
    const auto ev_of = [](std::uint64_t seed, std::optional<Parameters> parameters = {}) {
        Options options;
        options.brightness = Brightness{ 0, true };
        options.seed = seed;
        options.parameters = std::move(parameters);
        const auto raw = unprocess(kPhoto, options.parameters ? "" : kReference, options);
        REQUIRE_MESSAGE(raw, (raw ? "" : raw.error().message));
        CHECK(has(raw->spec().get_string_attribute("unprocess:notes"), "EV was drawn"));
        return recorded_parameters(raw->spec(), "raw")->brightness_ev;
    };
    const float first = ev_of(1);
    CHECK(ev_of(2) != first);
    CHECK(ev_of(1) == first);

    auto parameters = recorded_parameters(unprocess(kPhoto, kReference)->spec(), "raw");
    REQUIRE(parameters);
    CHECK(ev_of(1, *parameters) == first);
    parameters->brightness_sd_ev.reset();
    Options options;
    options.brightness = Brightness{ 0, true };
    options.parameters = *parameters;
    CHECK(has(refusal(unprocess(kPhoto, "", options)), "brightness 'sample' has no standard deviation to draw from"));
}

TEST_CASE("an unsure brightness is among the notes of a result, of chosen parameters and of given ones")
{
    const ScratchFolder folder;
    Options options;
    options.model = random_srisp_7_model(1, 2, 64, 1.25).write(folder.path("m.safetensors"));
    const auto raw = unprocess(kPhoto, kReference, options);
    REQUIRE_MESSAGE(raw, (raw ? "" : raw.error().message));
    const std::string note = "the brightness is unsure, its standard deviation is 1.25 EV; brightness=EV";
    CHECK(has(raw->spec().get_string_attribute("unprocess:notes"), note));
    const auto parameters = recorded_parameters(raw->spec(), "raw");
    REQUIRE(parameters);
    options.parameters = *parameters;
    const auto replayed = unprocess(kPhoto, "", options);
    REQUIRE(replayed);
    CHECK(has(replayed->spec().get_string_attribute("unprocess:notes"), note));
    options.parameters->brightness_sd_ev = 0.5f;
    CHECK(!has(unprocess(kPhoto, "", options)->spec().get_string_attribute("unprocess:notes"), "unsure"));
}

TEST_CASE("a PNG file holds the orientation")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec(4, 2, 3, OIIO::TypeFloat);
    spec.attribute("Orientation", 6);
    REQUIRE(Image(spec, std::vector<float>(24, 0.25f)).save(folder.path("a.png")));
    std::ostringstream bytes;
    bytes << std::ifstream(folder.path("a.png"), std::ios::binary).rdbuf();
    CHECK(has(bytes.str(), "eXIf"));
    CHECK(!has(bytes.str(), "srisp:Orientation"));
}

TEST_CASE("an image is saved in the type that its file can hold, under its name only when it is complete")
{
    const ScratchFolder folder;
    const Image image(OIIO::ImageSpec(4, 2, 3, OIIO::TypeFloat), std::vector<float>(24, 0.25f));
    for (const auto& [name, type] : { std::pair("a.exr", OIIO::TypeHalf), std::pair("a.tif", OIIO::TypeFloat),
                                      std::pair("a.png", OIIO::TypeUInt16), std::pair("a.jpg", OIIO::TypeUInt8) }) {
        const Status saved = image.save(folder.path(name));
        REQUIRE_MESSAGE(saved, saved.error().message);
        OIIO::TypeDesc stored;
        for (const float value : pixels_of(folder.path(name), stored))
            CHECK(std::abs(value - 0.25f) < 0.01f);
        CHECK(stored == type);
    }
    const std::string nowhere = folder.path("none/a.exr");
    const Status unsaved = image.save(nowhere);
    REQUIRE(!unsaved);
    CHECK(has(unsaved.error().message, "image '" + nowhere + "' cannot be written: "));
    const Status unknown = image.save(folder.path("a.docx"));
    REQUIRE(!unknown);
    CHECK(has(unknown.error().message, "a.docx' cannot be written: "));
    std::filesystem::create_directory(folder.path("b.png"));
    CHECK(!image.save(folder.path("b.png")));
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        files += !has(entry.path().string(), ".tmp-");
    CHECK(files == 5);
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 5);
}

TEST_CASE("what is wrong is said, and nothing is thrown")
{
    const ScratchFolder folder;
    const std::string none = folder.path("none.jpg"), garbage = folder.file("garbage.png", "no image");
    CHECK(refusal(unprocess(none, kReference)) == "photo '" + none + "': does not exist");
    CHECK(has(refusal(unprocess(garbage, kReference)), "photo '" + garbage + "': "));
    CHECK(has(refusal(unprocess(kPhoto, folder.path("none.dng"))), "reference '" + folder.path("none.dng") + "': "));
    CHECK(has(refusal(unprocess(kPhoto, garbage)), "garbage.png"));
    CHECK(has(refusal(unprocess(kPhoto, "")), "reference"));
    CHECK(has(refusal(process(kPhoto)), "records no parameters"));
    CHECK(has(refusal(process(none)), "image '" + none + "': does not exist"));
    Options options;
    options.model = "spatail";
    CHECK(has(refusal(unprocess(kPhoto, kReference, options)), "did you mean 'spatial'?"));
    CHECK(!set_option(options, "precison", "fast"));
}

TEST_CASE("one call develops: a photo, its RAW-like image, a camera's file")
{
    Options options;
    options.develop = "lin_rec2020";
    options.highlights = Highlights::keep;
    const auto at_once = unprocess(kPhoto, kReference, options);
    REQUIRE_MESSAGE(at_once, (at_once ? "" : at_once.error().message));
    CHECK(at_once->spec().get_string_attribute("oiio:ColorSpace") == "lin_rec2020");
    CHECK(at_once->spec().get_string_attribute("colorInteropID") == "lin_rec2020_scene");

    const ScratchFolder folder;
    const auto raw = unprocess(kPhoto, kReference);
    REQUIRE(raw);
    OIIO::ImageSpec spec = raw->spec();
    spec.set_format(OIIO::TypeFloat);
    const auto output = OIIO::ImageOutput::create(folder.path("raw.exr"));
    REQUIRE((output && output->open(folder.path("raw.exr"), spec) &&
             output->write_image(OIIO::TypeFloat, raw->pixels().data()) && output->close()));
    const auto later = develop(folder.path("raw.exr"), options);
    REQUIRE_MESSAGE(later, (later ? "" : later.error().message));
    CHECK(later->pixels() == at_once->pixels());

    const auto camera = develop(kReference);
    REQUIRE_MESSAGE(camera, (camera ? "" : camera.error().message));
    CHECK(camera->spec().get_string_attribute("oiio:ColorSpace") == "ACEScg");
    // What is bright and neutral in the file stays so: white balance is as shot.
    const ImageView view = camera->view();
    double sum[3] = {};
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            for (int c = 0; c < 3; ++c)
                sum[c] += view.pixel(x, y)[c];
    CHECK(std::abs(sum[0] / sum[1] - 1) < 0.25);
    CHECK(std::abs(sum[2] / sum[1] - 1) < 0.25);

    CHECK(has(refusal(develop(kPhoto)), "is neither a RAW-like image of srisp's nor a camera's RAW file"));
    CHECK(has(refusal(develop(folder.path("none.dng"))), "does not exist"));
    options.develop = "nothing";
    CHECK(has(refusal(develop(kReference, options)), "unknown scene-linear colour space 'nothing'"));
}

TEST_CASE("a sink gets the image's rows, and a file's bytes are those that are saved")
{
    Options options;
    options.noise = "shot=0.01,read=1e-4";
    const auto whole = unprocess(kPhoto, kReference, options);
    REQUIRE(whole);
    OIIO::ImageSpec spec;
    std::vector<float> pixels;
    ImageSink sink;
    sink.begin = [&](const OIIO::ImageSpec& known) -> Status {
        spec = known;
        return {};
    };
    sink.rows = [&](const float* rows, int count) -> Status {
        pixels.insert(pixels.end(), rows, rows + std::size_t(count) * spec.width * spec.nchannels);
        return {};
    };
    REQUIRE(unprocess(kPhoto, kReference, options, sink));
    CHECK(pixels == whole->pixels());
    CHECK(spec.height == whole->spec().height);

    const ScratchFolder folder;
    for (const char* name : { "raw.exr", "raw.tif", "raw.png" }) {
        const auto bytes = whole->encode(folder.path(name));
        REQUIRE(bytes);
        REQUIRE(whole->save(folder.path(name)));
        std::ostringstream saved;
        saved << std::ifstream(folder.path(name), std::ios::binary).rdbuf();
        CHECK(saved.str() == std::string(bytes->begin(), bytes->end()));
    }
    CHECK(!whole->encode("raw.nothing"));
}

TEST_CASE("an error of a sink ends the image")
{
    int calls = 0;
    ImageSink sink;
    sink.begin = [&](const OIIO::ImageSpec&) { return Status(Error{ "full" }); };
    sink.rows = [&](const float*, int) -> Status {
        ++calls;
        return {};
    };
    const Status done = unprocess(kPhoto, kReference, {}, sink);
    REQUIRE(!done);
    CHECK(done.error().message == "full");
    CHECK(calls == 0);
}
