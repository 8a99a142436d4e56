// SPDX-License-Identifier: Apache-2.0
// What our reader makes of photos: the same as the library by hand, whatever the kind of photo.
#include <cmath>
#include <limits>

#include <srisp/apply.h>
#include <srisp/metadata.h>
#include <srisp/model.h>
#include <srisp/reference.h>
#include <srisp/select.h>
#include <srisp/thumbnail.h>

#include "image_compare.h"
#include "shared_files.h"
#include "test_images.h"

using namespace srisp;
using namespace srisp::plugin;

namespace {

/// Display-encoded RGB → the result, by the library alone. `chosen` (if any) is told what was selected.
std::vector<float> unprocessed(std::vector<float> rgb, int width, int height, const std::string& reference,
                               int orientation = 1, Parameters* chosen = nullptr)
{
    const auto model = Model::load("default");
    REQUIRE_MESSAGE(bool(model), model.error().message);
    const auto loaded = load_reference(reference);
    REQUIRE_MESSAGE(bool(loaded), loaded.error().message);
    const MutableImageView view{ rgb.data(), width, height, 3, std::ptrdiff_t(3) * width };
    auto parameters = select(**model, make_thumbnail(view, orientation), (*loaded)->thumbnail);
    REQUIRE_MESSAGE(bool(parameters), parameters.error().message);
    const auto applier = Applier::create(**model, *parameters, Direction::reverse);
    REQUIRE(bool(applier));
    REQUIRE(bool((*applier)->run(view, view)));
    parameters->reference_name = (*loaded)->name;
    parameters->reference_hash = (*loaded)->hash;
    if (chosen)
        *chosen = *parameters;
    return rgb;
}

/// As the file's own reader gives it.
std::vector<float> stored_pixels(const std::string& path, OIIO::ImageSpec& spec)
{
    auto input = OIIO::ImageInput::open(path);
    REQUIRE(input);
    spec = input->spec();
    return read_all(*input);
}

std::vector<float> channels_of(const std::vector<float>& pixels, int channels, int first, int count)
{
    std::vector<float> part;
    for (std::size_t i = 0; i < pixels.size(); i += channels)
        part.insert(part.end(), pixels.begin() + i + first, pixels.begin() + i + first + count);
    return part;
}

} // namespace

TEST_CASE("the reader gives what the library gives, to the bit, over many bands")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = write_photo(folder, "photo.png", 120, 700);
    OIIO::ImageSpec stored, spec;
    const auto rgb = stored_pixels(photo, stored);
    Parameters expected;
    const auto by_hand = unprocessed(rgb, 120, 700, reference, 1, &expected);
    CHECK(result_of(photo + ".srisp?reference=" + reference, spec) == by_hand);
    const auto parameters = recorded_parameters(spec, "result");
    REQUIRE_MESSAGE(bool(parameters), parameters.error().message);
    CHECK(to_json(*parameters) == to_json(expected));
    CHECK(spec.get_string_attribute("oiio:ColorSpace") == "camera_rgb");
}

TEST_CASE("16-bit and half files lose nothing on the way in")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder);
    for (const auto& [name, type] : { std::pair("p.tif", OIIO::TypeUInt16), std::pair("p.png", OIIO::TypeUInt16) }) {
        write_image(folder.path(name), OIIO::ImageSpec(40, 30, 3, type), test_pixels(40, 30, 3));
        OIIO::ImageSpec stored, spec;
        const auto rgb = stored_pixels(folder.path(name), stored);
        CHECK(result_of(folder.path(name) + ".srisp?reference=" + reference, spec) ==
              unprocessed(rgb, 40, 30, reference));
    }
}

TEST_CASE("a linear EXR is encoded first, unless input=srgb says otherwise")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = folder.path("p.exr");
    write_image(photo, OIIO::ImageSpec(40, 30, 3, OIIO::TypeHalf), test_pixels(40, 30, 3));
    OIIO::ImageSpec stored, spec;
    auto rgb = stored_pixels(photo, stored);
    const std::string query = photo + ".srisp?reference=" + reference;
    CHECK(result_of(query + "&input=srgb", spec) == unprocessed(rgb, 40, 30, reference));
    for (float& v : rgb)
        v = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
    const Difference difference = compare(result_of(query, spec), unprocessed(rgb, 40, 30, reference));
    INFO(difference.text);
    CHECK(difference.largest < 1e-4);
}

TEST_CASE("a grey photo gives three channels")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = folder.path("grey.png");
    write_image(photo, OIIO::ImageSpec(40, 30, 1, OIIO::TypeUInt8), test_pixels(40, 30, 1));
    OIIO::ImageSpec stored, spec;
    std::vector<float> rgb;
    for (const float v : stored_pixels(photo, stored))
        rgb.insert(rgb.end(), 3, v);
    CHECK(result_of(photo + ".srisp?reference=" + reference, spec) == unprocessed(rgb, 40, 30, reference));
    CHECK(spec.nchannels == 3);
}

TEST_CASE("straight colour is processed, also where alpha is small, and comes out associated")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = folder.path("rgba.png");
    OIIO::ImageSpec written(40, 30, 4, OIIO::TypeUInt8);
    written.attribute("oiio:UnassociatedAlpha", 1);
    write_image(photo, written, test_pixels(40, 30, 4, 0.0f, 1.0f));
    OIIO::ImageSpec straight;
    straight.attribute("oiio:UnassociatedAlpha", 1);
    auto input = OIIO::ImageInput::open(photo, &straight);
    REQUIRE(input);
    const auto stored = read_all(*input);
    const auto alpha = channels_of(stored, 4, 3, 1);
    const auto rgb = unprocessed(channels_of(stored, 4, 0, 3), 40, 30, reference);

    OIIO::ImageSpec spec;
    const auto result = result_of(photo + ".srisp?reference=" + reference, spec, straight);
    CHECK(channels_of(result, 4, 0, 3) == rgb);
    CHECK(channels_of(result, 4, 3, 1) == alpha);
    CHECK(spec.get_int_attribute("oiio:UnassociatedAlpha") == 1);

    auto associated = rgb;
    for (std::size_t i = 0; i < associated.size(); ++i)
        associated[i] *= alpha[i / 3];
    const auto usual = result_of(photo + ".srisp?reference=" + reference, spec);
    CHECK(channels_of(usual, 4, 0, 3) == associated);
    CHECK(!spec.find_attribute("oiio:UnassociatedAlpha"));
}

TEST_CASE("grey with alpha becomes RGBA")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = folder.path("ga.png");
    OIIO::ImageSpec written(40, 30, 2, OIIO::TypeUInt8);
    written.channelnames = { "Y", "A" };
    written.alpha_channel = 1;
    written.attribute("oiio:UnassociatedAlpha", 1);
    write_image(photo, written, test_pixels(40, 30, 2, 0.2f, 1.0f));
    OIIO::ImageSpec spec;
    const auto result = result_of(photo + ".srisp?reference=" + reference, spec);
    CHECK(spec.channelnames == std::vector<std::string>{ "R", "G", "B", "A" });
    CHECK(spec.alpha_channel == 3);
    for (const float v : result)
        REQUIRE(std::isfinite(v));
}

TEST_CASE("pixels stay as stored and the orientation tag is kept, but the choice is made upright")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = folder.path("turned.tif");
    OIIO::ImageSpec written(40, 30, 3, OIIO::TypeUInt8), stored, spec;
    written.attribute("Orientation", 6);
    write_image(photo, written, test_pixels(40, 30, 3));
    const auto rgb = stored_pixels(photo, stored);
    Parameters upright, sideways;
    const auto expected = unprocessed(rgb, 40, 30, reference, 6, &upright);
    unprocessed(rgb, 40, 30, reference, 1, &sideways);
    CHECK(to_json(upright) != to_json(sideways));
    CHECK(result_of(photo + ".srisp?reference=" + reference, spec) == expected);
    CHECK(spec.width == 40);
    CHECK(spec.get_int_attribute("Orientation") == 6);
}

TEST_CASE("windows and other channels are kept, and only the data window is looked at")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = folder.path("window.exr");
    OIIO::ImageSpec written(40, 30, 5, OIIO::TypeFloat), stored, spec;
    written.x = -7;
    written.y = 11;
    written.full_x = -20;
    written.full_y = 0;
    written.full_width = 200;
    written.full_height = 100;
    written.channelnames = { "R", "G", "B", "A", "depth" };
    written.alpha_channel = 3;
    auto pixels = test_pixels(40, 30, 5);
    for (std::size_t i = 3; i < pixels.size(); i += 5)
        pixels[i] = 1;
    pixels[4] = std::numeric_limits<float>::infinity();
    write_image(photo, written, pixels);
    const auto read = stored_pixels(photo, stored);
    const auto rgb = unprocessed(channels_of(read, 5, 0, 3), 40, 30, reference);
    const auto result = result_of(photo + ".srisp?reference=" + reference + "&input=srgb", spec);
    CHECK(spec.x == -7);
    CHECK(spec.y == 11);
    CHECK(spec.full_x == -20);
    CHECK(spec.full_width == 200);
    CHECK(channels_of(result, 5, 0, 3) == rgb);
    CHECK(channels_of(result, 5, 3, 2) == channels_of(read, 5, 3, 2));
}

TEST_CASE("NaN and clipped values are counted in a note")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = folder.path("bad.exr");
    auto pixels = test_pixels(40, 30, 3);
    pixels[100] = std::numeric_limits<float>::quiet_NaN();
    pixels[200] = 17;
    pixels[300] = -1;
    write_image(photo, OIIO::ImageSpec(40, 30, 3, OIIO::TypeFloat), pixels);
    OIIO::ImageSpec spec;
    for (const float v : result_of(photo + ".srisp?reference=" + reference, spec))
        REQUIRE(std::isfinite(v));
    const std::string notes = spec.get_string_attribute("unprocess:notes");
    CHECK(has(notes, "2 of 3600 colour values lay outside sRGB's 0 to 1 and were clipped"));
    CHECK(has(notes, "1 of 3600 colour values were not numbers and became 0"));
}

TEST_CASE("a CMYK photo is refused")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = folder.path("cmyk.tif");
    OIIO::ImageSpec written(40, 30, 3, OIIO::TypeUInt8);
    written.attribute("tiff:ColorSpace", "CMYK");
    write_image(photo, written, test_pixels(40, 30, 3));
    CHECK(has(refusal_of(photo + ".srisp?reference=" + reference), "is a CMYK image; convert it to RGB first"));
}

TEST_CASE("1 × 1 works")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = write_photo(folder, "dot.png", 1, 1);
    OIIO::ImageSpec stored, spec;
    const auto rgb = stored_pixels(photo, stored);
    CHECK(result_of(photo + ".srisp?reference=" + reference, spec) == unprocessed(rgb, 1, 1, reference));
}

TEST_CASE("recorded parameters bring the photo back, and parameters alone replay to the bit")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = write_photo(folder);
    SrispInput input;
    OIIO::ImageSpec spec = open_ours(input, photo + ".srisp?reference=" + reference);
    const auto raw = read_all(input);
    write_image(folder.path("raw.exr"), spec, raw);

    OIIO::ImageSpec forward;
    const auto back = result_of(folder.path("raw.exr") + ".srisp?direction=forward", forward);
    CHECK(forward.get_string_attribute("oiio:ColorSpace") == "sRGB");
    CHECK(!is_unprocessed(forward));
    OIIO::ImageSpec stored;
    const auto rgb = stored_pixels(photo, stored);
    double sum = 0;
    for (std::size_t i = 0; i < rgb.size(); ++i)
        sum += std::abs(back[i] - rgb[i]);
    CHECK(sum / rgb.size() < 0.05);

    folder.file("p.json", to_json(*recorded_parameters(spec, "raw")));
    OIIO::ImageSpec replayed;
    CHECK(result_of(photo + ".srisp?params=" + folder.path("p.json"), replayed) == raw);
    CHECK(has(refusal_of(photo + ".srisp?direction=forward"), "records no parameters; give params="));
    CHECK(has(refusal_of(folder.path("raw.exr") + ".srisp?reference=" + reference), "RAW-like image already"));
}

TEST_CASE("what is wrong is said on opening")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = write_photo(folder);
    CHECK(has(refusal_of(photo + ".srisp?reference=" + folder.path("none.dng")), "none.dng"));
    CHECK(has(refusal_of(photo + ".srisp?reference=" + folder.path("none.dng") + "&lazy=1"), "none.dng"));
    CHECK(has(refusal_of(photo + ".srisp?reference=" + reference + "&model=spatail"), "did you mean 'spatial'?"));
    CHECK(has(refusal_of(folder.path("none.jpg.srisp?reference=") + reference), "none.jpg': does not exist"));
    CHECK(has(refusal_of(folder.path(".srisp?reference=") + reference), "is a folder"));
    const std::string garbage = folder.file("garbage.png", "no image");
    CHECK(has(refusal_of(garbage + ".srisp?reference=" + reference), "photo '" + garbage + "'"));
    CHECK(has(refusal_of(photo + ".srisp.srisp?reference=" + reference), "a recipe cannot be made from a recipe"));
    CHECK(has(refusal_of(photo + ".srisp?params=" + folder.file("p.json", "{}")), "p.json"));
    OIIO::ImageSpec nowait;
    nowait.attribute("nowait", 1);
    CHECK(has(refusal_of(photo + ".srisp?reference=" + reference, nowait), "is not a recipe"));
}

TEST_CASE("lazy opening reads headers only")
{
    const ScratchFolder folder;
    const std::string photo = write_photo(folder);
    const std::string broken = folder.file("broken.dng", "this is no RAW file");
    SrispInput input;
    const OIIO::ImageSpec header = open_ours(input, photo + ".srisp?lazy=1&reference=" + broken);
    CHECK(header.width == 90);
    CHECK(is_unprocessed(header));
    CHECK(!recorded_parameters(header, "x"));
    std::vector<float> row(90 * 3);
    CHECK(!input.read_scanlines(0, 0, 0, 1, 0, 0, 3, OIIO::TypeFloat, row.data()));
    CHECK(has(input.geterror(), "broken.dng"));

    SrispInput eager, lazy;
    const std::string reference = write_reference(folder);
    open_ours(lazy, photo + ".srisp?lazy=1&reference=" + reference);
    open_ours(eager, photo + ".srisp?reference=" + reference);
    CHECK(read_all(lazy) == read_all(eager));
}

TEST_CASE("which of several references is taken depends on seed and photo name")
{
    const ScratchFolder folder;
    const std::string photo = write_photo(folder);
    std::string list;
    for (const char* name : { "a.exr", "b.exr", "c.exr", "d.exr" })
        list += (list.empty() ? "" : ";") + write_reference(folder, name);
    std::vector<std::string> taken;
    for (int seed = 0; seed < 8; ++seed) {
        OIIO::ImageSpec spec;
        SrispInput input;
        spec = open_ours(input, photo + ".srisp?reference=" + list + "&seed=" + std::to_string(seed));
        taken.push_back(spec.get_string_attribute("unprocess:reference"));
        SrispInput again;
        CHECK(open_ours(again, photo + ".srisp?reference=" + list + "&seed=" + std::to_string(seed))
                  .get_string_attribute("unprocess:reference") == taken.back());
    }
    CHECK(std::count(taken.begin(), taken.end(), taken[0]) < 8);
}

TEST_CASE("a changed photo is not taken for the one before")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = write_photo(folder);
    OIIO::ImageSpec first, second;
    result_of(photo + ".srisp?reference=" + reference, first);
    write_image(photo, OIIO::ImageSpec(90, 70, 3, OIIO::TypeUInt8), test_pixels(90, 70, 3, 0.0f, 0.3f));
    result_of(photo + ".srisp?reference=" + reference, second);
    CHECK(to_json(*recorded_parameters(first, "x")) != to_json(*recorded_parameters(second, "x")));
}
