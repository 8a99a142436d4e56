// SPDX-License-Identifier: Apache-2.0
// The rules of the DNG specification, and what readers demand beyond it, tag by tag.
#include <srisp/dng.h>

#include <algorithm>
#include <optional>

#include "lib/dng/made_dng.h"
#include "raw_file/tiff_tags.h"

using namespace srisp;

namespace {

enum Type : std::uint16_t {
    kByte = 1,
    kAscii = 2,
    kShort = 3,
    kLong = 4,
    kRational = 5,
    kUndefined = 7,
    kSRational = 10,
    kDouble = 12
};

/// A DNG that was written, and its tags.
class WrittenDng {
public:
    explicit WrittenDng(const DngImage& image, const DngOptions& options = {})
    {
        const ScratchFolder folder;
        notes = written(folder.path("a.dng"), image, options);
        m_file = read_file(folder.path("a.dng"));
        m_tags.emplace(m_file.data.get(), m_file.size);
    }

    const std::vector<TiffFolder>& folders() const { return m_tags->folders(); }
    const TiffFolder& exif() const { return m_tags->exif(); }
    const TiffTags& tags() const { return *m_tags; }
    const FileBytes& file() const { return m_file; }

    void check(const TiffFolder& folder, std::uint16_t tag, Type type, const std::vector<double>& values) const
    {
        CAPTURE(tag);
        const TiffTag* found = folder.find(tag);
        REQUIRE(found != nullptr);
        CHECK(found->type == type);
        const std::vector<double> read = m_tags->values(folder, tag);
        REQUIRE(read.size() == values.size());
        for (std::size_t i = 0; i < values.size(); ++i)
            CHECK(float(read[i]) == float(values[i]));
    }

    std::vector<std::string> notes;

private:
    FileBytes m_file;
    std::optional<TiffTags> m_tags;
};

const std::vector<std::uint16_t> kCameraTags = { 271,   272,   274,   305,   50706, 50707, 50708,
                                                 50721, 50722, 50728, 50730, 50778, 50779 };

} // namespace

TEST_CASE("Tags of each folder are sorted, once each, and there is no further folder")
{
    MadeImage made(64, 48, 1);
    made.with_preview(16, 12);
    for (const auto layout : { DngLayout::standard, DngLayout::cinema }) {
        const WrittenDng dng(made.image, { DngCompression::lossless, 16, layout, 0 });
        CHECK(dng.folders().size() == (layout == DngLayout::standard ? 2 : 1));
        CHECK(dng.tags().problem().empty());
        std::vector<TiffFolder> all = dng.folders();
        all.push_back(dng.exif());
        for (const TiffFolder& folder : all) {
            CHECK(folder.offset % 2 == 0);
            CHECK(std::is_sorted(folder.tags.begin(), folder.tags.end(),
                                 [](const TiffTag& a, const TiffTag& b) { return a.tag <= b.tag; }));
            CHECK((folder.find(258) != nullptr || folder.offset == dng.exif().offset));
        }
    }
}

TEST_CASE("The first folder of the standard layout is the preview's, and says what the camera is")
{
    MadeImage made(64, 48, 1);
    made.with_preview(15, 11);
    const WrittenDng dng(made.image);
    const TiffFolder& first = dng.folders()[0];
    dng.check(first, 254, kLong, { 1 });
    dng.check(first, 256, kLong, { 15 });
    dng.check(first, 257, kLong, { 11 });
    dng.check(first, 258, kShort, { 8, 8, 8 });
    dng.check(first, 259, kShort, { 1 });
    dng.check(first, 262, kShort, { 2 });
    dng.check(first, 277, kShort, { 3 });
    dng.check(first, 278, kLong, { 11 });
    dng.check(first, 279, kLong, { 15 * 11 * 3 });
    dng.check(first, 284, kShort, { 1 });
    dng.check(first, 50970, kLong, { 2 });
    const std::size_t at = std::size_t(dng.tags().value(first, 273, 0));
    REQUIRE(at + made.preview().size() <= dng.file().size);
    CHECK(std::equal(made.preview().begin(), made.preview().end(), dng.file().data.get() + at));
    for (const std::uint16_t tag : kCameraTags) {
        CAPTURE(tag);
        CHECK(first.find(tag) != nullptr);
        CHECK(dng.folders()[1].find(tag) == nullptr);
    }
}

TEST_CASE("The RAW image's folder is complete")
{
    MadeImage made(67, 35, 1);
    made.with_preview(16, 12);
    made.image.cfa_pattern = "GBRG";
    const WrittenDng dng(made.image);
    const TiffFolder& raw = dng.folders()[1];
    dng.check(dng.folders()[0], 330, kLong, { double(raw.offset) });
    dng.check(raw, 254, kLong, { 0 });
    dng.check(raw, 256, kLong, { 67 });
    dng.check(raw, 257, kLong, { 35 });
    dng.check(raw, 258, kShort, { 16 });
    dng.check(raw, 259, kShort, { 7 });
    dng.check(raw, 262, kShort, { 32803 });
    dng.check(raw, 277, kShort, { 1 });
    dng.check(raw, 284, kShort, { 1 });
    dng.check(raw, 322, kLong, { 48 }); // a multiple of 16
    dng.check(raw, 323, kLong, { 48 });
    CHECK(raw.find(324)->count == 2);
    CHECK(raw.find(325)->count == 2);
    for (const std::uint16_t absent : { 273, 278, 279 })
        CHECK(raw.find(absent) == nullptr);
    dng.check(raw, 33421, kShort, { 2, 2 });
    dng.check(raw, 33422, kByte, { 1, 2, 0, 1 });
    dng.check(raw, 50710, kByte, { 0, 1, 2 });
    dng.check(raw, 50711, kShort, { 1 });
    dng.check(raw, 50713, kShort, { 1, 1 });
    dng.check(raw, 50714, kRational, { 0 });
    dng.check(raw, 50717, kLong, { 65535 });
    dng.check(raw, 50718, kRational, { 1, 1 });
    dng.check(raw, 50719, kLong, { 0, 0 });
    dng.check(raw, 50720, kLong, { 67, 35 });
    dng.check(raw, 50829, kLong, { 0, 0, 35, 67 });
}

TEST_CASE("Without a preview, and in the layout 'cinema', the RAW image is in the first folder")
{
    MadeImage made(64, 48, 1);
    const WrittenDng plain(made.image);
    CHECK(plain.folders().size() == 1);
    plain.check(plain.folders()[0], 254, kLong, { 0 });
    CHECK(plain.folders()[0].find(330) == nullptr);

    made.with_preview(16, 12);
    for (const auto compression : { DngCompression::none, DngCompression::lossless }) {
        const WrittenDng cinema(made.image, { compression, 16, DngLayout::cinema, 0 });
        const TiffFolder& only = cinema.folders()[0];
        CHECK(cinema.folders().size() == 1);
        cinema.check(only, 254, kLong, { 0 });
        CHECK(only.find(330) == nullptr);
        CHECK(only.find(50970) == nullptr);
        CHECK((only.find(324) == nullptr) == (compression == DngCompression::none));
        CHECK((only.find(273) == nullptr) == (compression == DngCompression::lossless));
        for (const std::uint16_t tag : kCameraTags)
            CHECK(only.find(tag) != nullptr);
    }
}

TEST_CASE("Tiles are such as all readers read: never one alone, none wider than the image, none half as wide")
{
    struct Case {
        int width, height;
        DngLayout layout;
        double tile_width, tile_height;
        std::uint32_t tiles;
    };
    for (const Case& one :
         { Case{ 1500, 300, DngLayout::standard, 512, 304, 3 }, Case{ 1024, 300, DngLayout::standard, 496, 304, 3 },
           Case{ 67, 600, DngLayout::standard, 48, 512, 4 }, Case{ 64, 48, DngLayout::standard, 64, 32, 2 },
           Case{ 32, 22, DngLayout::standard, 32, 16, 2 }, Case{ 1500, 300, DngLayout::cinema, 752, 304, 2 },
           Case{ 1920, 1080, DngLayout::cinema, 1920, 544, 2 } }) {
        CAPTURE(one.width);
        MadeImage made(one.width, one.height, 1);
        const WrittenDng dng(made.image, { DngCompression::lossless, 16, one.layout, 0 });
        const TiffFolder& raw = dng.folders()[0];
        dng.check(raw, 322, kLong, { one.tile_width });
        dng.check(raw, 323, kLong, { one.tile_height });
        CHECK(raw.find(324)->count == one.tiles);
        CHECK(raw.find(325)->count == one.tiles);
    }
}

TEST_CASE("The camera: names, matrices with their lights, as-shot neutral, orientation, no analog balance")
{
    MadeImage made(64, 48, 1);
    made.image.baseline_exposure = -0.5f;
    made.image.description = "made here";
    made.image.xmp = "<x:xmpmeta/>";
    made.image.facts.noise_profile = { 1e-4, 1e-7, 2e-4, 2e-7, 3e-4, 3e-7 };
    const WrittenDng dng(made.image);
    const TiffFolder& first = dng.folders()[0];
    CHECK(dng.tags().text(first, 271) == "Maker");
    CHECK(dng.tags().text(first, 272) == "Model 5");
    CHECK(dng.tags().text(first, 50708) == "Maker Model 5");
    CHECK(dng.tags().text(first, 270) == "made here");
    CHECK(dng.tags().text(first, 305) == "srisp " SRISP_TEST_VERSION);
    CHECK(dng.tags().bytes(first, 700) == "<x:xmpmeta/>");
    dng.check(first, 274, kShort, { 6 });
    dng.check(first, 50721, kSRational, { 0.9, -0.2, -0.1, -0.4, 1.2, 0.2, -0.1, 0.2, 0.6 });
    CHECK(first.find(50722)->type == kSRational);
    dng.check(first, 50778, kShort, { 17 });
    dng.check(first, 50779, kShort, { 21 });
    dng.check(first, 50728, kRational, { 0.4737, 1, 0.6512 });
    dng.check(first, 50730, kSRational, { -0.5 });
    dng.check(first, 51041, kDouble, { 1e-4, 1e-7, 2e-4, 2e-7, 3e-4, 3e-7 });
    for (const std::uint16_t absent : { 50723, 50724, 50727, 50729 }) // calibration, balance, AsShotWhiteXY
        CHECK(first.find(absent) == nullptr);
    dng.check(dng.exif(), 33434, kRational, { 1.0 / 60 });
    dng.check(dng.exif(), 33437, kRational, { 2.8 });
    dng.check(dng.exif(), 34855, kShort, { 400 });
    CHECK(dng.notes.empty());
}

TEST_CASE("Of two matrices daylight's comes last, which dcraw takes, whatever order the facts have")
{
    MadeImage made(64, 48, 1);
    const WrittenDng in_order(made.image);
    std::swap(made.image.facts.color_matrices[0], made.image.facts.color_matrices[1]);
    const WrittenDng swapped(made.image);
    for (const WrittenDng* dng : { &in_order, &swapped }) {
        const TiffFolder& first = dng->folders()[0];
        dng->check(first, 50778, kShort, { 17 });
        dng->check(first, 50779, kShort, { 21 });
        CHECK(dng->tags().values(first, 50721)[0] == doctest::Approx(0.9));
        CHECK(dng->tags().values(first, 50722)[0] == doctest::Approx(0.7034));
    }
}

TEST_CASE("Versions are as low as the contents allow")
{
    MadeImage made(64, 48, 3);
    for (const auto compression : { DngCompression::none, DngCompression::lossless }) {
        const WrittenDng integers(made.image, { compression, 16, DngLayout::standard, 0 });
        integers.check(integers.folders()[0], 50706, kByte, { 1, 4, 0, 0 });
        integers.check(integers.folders()[0], 50707, kByte, { 1, 1, 0, 0 });
    }
    made.as_floats();
    const WrittenDng floats(made.image, { DngCompression::deflate, 32, DngLayout::standard, 0 });
    floats.check(floats.folders()[0], 50706, kByte, { 1, 4, 0, 0 });
    floats.check(floats.folders()[0], 50707, kByte, { 1, 4, 0, 0 });
}

TEST_CASE("LinearRaw has three samples a pixel and no filters; floats say that they are")
{
    MadeImage made(64, 48, 3, 12);
    const WrittenDng linear(made.image, { DngCompression::none, 12, DngLayout::standard, 0 });
    const TiffFolder& raw = linear.folders()[0];
    linear.check(raw, 258, kShort, { 12, 12, 12 });
    linear.check(raw, 259, kShort, { 1 });
    linear.check(raw, 262, kShort, { 34892 });
    linear.check(raw, 277, kShort, { 3 });
    linear.check(raw, 279, kLong, { 64 * 48 * 3 * 1.5 });
    linear.check(raw, 50714, kRational, { 0, 0, 0 });
    linear.check(raw, 50717, kLong, { 4095, 4095, 4095 });
    for (const std::uint16_t absent : { 33421, 33422, 50710, 50711, 339, 317 })
        CHECK(raw.find(absent) == nullptr);

    made.as_floats();
    const WrittenDng floats(made.image, { DngCompression::deflate, 16, DngLayout::standard, 0 });
    floats.check(floats.folders()[0], 258, kShort, { 16, 16, 16 });
    floats.check(floats.folders()[0], 259, kShort, { 8 });
    floats.check(floats.folders()[0], 317, kShort, { 3 });
    floats.check(floats.folders()[0], 339, kShort, { 3, 3, 3 });
    floats.check(floats.folders()[0], 50717, kLong, { 1, 1, 1 });
}

TEST_CASE("Without facts the camera is neutral: linear sRGB in daylight, and said to be so")
{
    MadeImage made(64, 48, 1);
    made.image.facts = {};
    const WrittenDng dng(made.image);
    const TiffFolder& first = dng.folders()[0];
    CHECK(first.find(271) == nullptr);
    CHECK(first.find(272) == nullptr);
    CHECK(dng.tags().text(first, 50708) == "srisp neutral camera");
    dng.check(first, 274, kShort, { 1 });
    dng.check(first, 50778, kShort, { 21 });
    CHECK(first.find(50722) == nullptr);
    CHECK(dng.tags().values(first, 50721)[0] == doctest::Approx(3.2404542)); // of XYZ to linear sRGB
    for (const double neutral : dng.tags().values(first, 50728))
        CHECK(neutral == doctest::Approx(1).epsilon(1e-5));
    CHECK(dng.exif().find(34855) == nullptr);
    CHECK(dng.notes ==
          std::vector<std::string>{ "no colour matrix is known: the image's colours were taken as linear sRGB",
                                    "no as-shot neutral is known: daylight (D65) was assumed" });
}

TEST_CASE("A calibration light is never 0: an unknown one is D65 where no other matrix is there")
{
    MadeImage made(64, 48, 1);
    made.image.facts.color_matrices[0].illuminant = 0;
    const WrittenDng second(made.image);
    second.check(second.folders()[0], 50778, kShort, { 21 });
    CHECK(second.folders()[0].find(50779) == nullptr);
    CHECK(second.tags().values(second.folders()[0], 50721)[0] == doctest::Approx(0.7034));

    made.image.facts.color_matrices.pop_back();
    const WrittenDng only(made.image);
    only.check(only.folders()[0], 50778, kShort, { 21 });
    CHECK(only.tags().values(only.folders()[0], 50721)[0] == doctest::Approx(0.9));
    CHECK(only.notes ==
          std::vector<std::string>{ "the light of the camera's colour matrix is not known: D65 was assumed" });
}

TEST_CASE("A matrix without an inverse and a noise profile that cannot be are left out, and that is noted")
{
    MadeImage made(64, 48, 1);
    made.image.facts.color_matrices[0].xyz_to_camera.fill(1);
    made.image.facts.noise_profile = { 1, 2, 3 };
    const WrittenDng dng(made.image);
    dng.check(dng.folders()[0], 50778, kShort, { 21 });
    CHECK(dng.folders()[0].find(51041) == nullptr);
    CHECK(dng.notes ==
          std::vector<std::string>{ "a noise profile of 3 values was left out: 2 or 6, none below 0, are possible",
                                    "a colour matrix that has no inverse was left out" });
}

TEST_CASE("The unique model does not say the maker twice")
{
    MadeImage made(64, 48, 1);
    made.image.facts.make = "Canon";
    made.image.facts.model = "Canon EOS R5";
    const WrittenDng dng(made.image);
    CHECK(dng.tags().text(dng.folders()[0], 50708) == "Canon EOS R5");
}
