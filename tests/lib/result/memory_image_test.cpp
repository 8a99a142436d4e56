// SPDX-License-Identifier: Apache-2.0
#include <srisp/image_input.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <limits>

#include <OpenImageIO/imagebuf.h>
#include <doctest/doctest.h>
#include <srisp/srisp.h>

#include "scratch_folder.h"

using namespace srisp;

namespace {

const std::string kSample = std::string(SRISP_SOURCE_DIR) + "/configs/sample/";
const std::string kPhoto = kSample + "photo.jpg", kReference = kSample + "reference.dng";

/// The sample's own codes, and a view of them.
struct Codes {
    Codes()
    {
        const auto input = OIIO::ImageInput::open(kPhoto);
        REQUIRE(input);
        const OIIO::ImageSpec& spec = input->spec();
        values.resize(spec.image_pixels() * 3);
        REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeUInt8, values.data()));
        image.spec = OIIO::ImageSpec(spec.width, spec.height, 3, OIIO::TypeUInt8);
        image.pixels = values.data();
    }
    std::vector<unsigned char> values;
    MemoryImage image;
};

const Image& value(const Expected<Image>& image)
{
    REQUIRE_MESSAGE(image, (image ? "" : image.error().message));
    return *image;
}

std::string refusal(const Expected<Image>& image)
{
    REQUIRE(!image);
    return image.error().message;
}

} // namespace

TEST_CASE("an image in memory gives the bits of its file")
{
    const Codes codes;
    const auto file = unprocess(kPhoto, kReference), memory = unprocess(codes.image, kReference);
    CHECK(value(memory).pixels() == value(file).pixels());
    CHECK(value(memory).spec().get_string_attribute("unprocess:record") ==
          value(file).spec().get_string_attribute("unprocess:record"));
    const auto loaded = load_reference(kReference);
    REQUIRE(loaded);
    CHECK(value(unprocess(codes.image, *loaded)).pixels() == file->pixels());
    CHECK(value(read_photo(codes.image)).pixels() == value(read_photo(kPhoto)).pixels());
}

TEST_CASE("strides may be any, also backwards")
{
    const Codes codes;
    const auto expected = unprocess(codes.image, kReference);
    const int width = codes.image.spec.width, height = codes.image.spec.height;
    // Planes of doubles, from the bottom right on.
    const std::size_t plane = std::size_t(width) * std::size_t(height);
    std::vector<double> planes(plane * 3);
    for (std::size_t i = 0; i < plane; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            planes[c * plane + plane - 1 - i] = codes.values[i * 3 + c] / 255.0;
    MemoryImage image;
    image.spec = OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::DOUBLE);
    image.spec.attribute("oiio:ColorSpace", "sRGB");
    image.pixels = planes.data() + plane - 1;
    image.channel_stride = OIIO::stride_t(plane * sizeof(double));
    image.x_stride = -OIIO::stride_t(sizeof(double));
    image.y_stride = image.x_stride * width;
    const auto made = unprocess(image, kReference);
    double most = 0;
    for (std::size_t i = 0; i < value(made).pixels().size(); ++i)
        most = std::max(most, double(std::abs(made->pixels()[i] - value(expected).pixels()[i])));
    CHECK(most < 1e-5); // a double's sRGB is not the code's float
}

TEST_CASE("an image in memory that is none is refused by its name")
{
    MemoryImage image;
    image.name = "frame 7";
    image.spec = OIIO::ImageSpec(4, 4, 3, OIIO::TypeUInt8);
    CHECK(refusal(unprocess(image, kReference)) == "photo 'frame 7': has no pixels");
    image.spec = OIIO::ImageSpec(0, 4, 3, OIIO::TypeUInt8);
    CHECK(refusal(process(image)).find("image 'frame 7': is empty: 0 x 4 pixels") == 0);
    image.name.clear();
    CHECK(refusal(develop(image)).find("image in memory: is empty") == 0);
    const Codes codes;
    Options options;
    options.gain_map = GainMapUse::apply;
    CHECK(refusal(unprocess(codes.image, kReference, options)).find("gainmap=apply") != std::string::npos);
}

TEST_CASE("what a sensor sees is the same at once and step by step, and a DNG needs no folder of plugins to be named")
{
    Options options;
    options.mosaic = Mosaic::grbg;
    options.noise = "shot=0.01,read=1e-4";
    options.noise_seed = 3;
    const Codes codes;
    const auto at_once = unprocess(codes.image, kReference, options), raw = unprocess(codes.image, kReference);
    MemoryImage view;
    view.spec = value(raw).spec();
    view.pixels = raw->pixels().data();
    const auto after = sense(view, options);
    CHECK(value(after).pixels() == value(at_once).pixels());
    CHECK(recorded_cfa_pattern(after->spec()) == "GRBG");
    OIIO::ImageSpec spec = after->spec();
    record_cfa_pattern(spec, "");
    CHECK(recorded_cfa_pattern(spec).empty());
    CHECK(recorded_parameters(spec, "raw"));
    CHECK(refusal(sense(view, Options())) == "image in memory: names neither mosaic nor noise");
}

TEST_CASE("who is asked may cancel, while reading and while computing")
{
    const Codes codes;
    for (const int last : { 0, 1, 2 }) {
        int asked = 0;
        ImageSink sink;
        sink.begin = [](const OIIO::ImageSpec&) { return Status(); };
        sink.rows = [](const float*, int) { return Status(); };
        sink.cancelled = [&] { return asked++ == last; };
        const Status done = unprocess(codes.image, kReference, {}, sink);
        REQUIRE(!done);
        CHECK(done.error().message.find("cancelled") != std::string::npos);
        CHECK(asked == last + 1);
    }
}

TEST_CASE("a process that was forked computes with its one thread")
{
    const Codes codes;
    const auto expected = unprocess(codes.image, kReference); // the pool has its threads
    const pid_t child = fork();
    if (child == 0) {
        alarm(30);
        const auto made = unprocess(codes.image, kReference);
        _exit(made && expected && made->pixels() == expected->pixels() ? 0 : 1);
    }
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(status == 0);
}
