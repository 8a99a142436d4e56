// SPDX-License-Identifier: Apache-2.0
#include "container/image_file.h"

#include <algorithm>
#include <cmath>

#include <webp/encode.h>

#include "color/color_encoding.h"
#include "container/file_description.h"
#include "icc_profiles.h"
#include "lib/container/made_files.h"
#include "scratch_folder.h"

using namespace srisp;

namespace {

OIIO::ImageSpec made_spec(int channels, OIIO::TypeDesc type = OIIO::TypeUInt8)
{
    return { 16, 12, channels, type };
}

OIIO::ImageSpec straight()
{
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    return config;
}

std::unique_ptr<ImageFile> opened(const std::string& path, const OIIO::ImageSpec& config = {})
{
    auto file = ImageFile::open(path, config, "photo");
    REQUIRE_MESSAGE(file, (file ? "" : file.error().message));
    return std::move(*file);
}

std::string refusal(const std::string& path)
{
    const auto file = ImageFile::open(path, {}, "photo");
    REQUIRE(!file);
    return file.error().message;
}

/// Empty: reading fails.
std::vector<float> pixels_of(ImageFile& file)
{
    std::vector<float> pixels(std::size_t(file.spec().image_pixels()) * file.spec().nchannels);
    if (!file.read_image(0, 0, 0, file.spec().nchannels, OIIO::TypeFloat, pixels.data()))
        pixels.clear();
    return pixels;
}

double largest_difference(const std::vector<float>& a, const std::vector<float>& b)
{
    REQUIRE(a.size() == b.size());
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, double(std::fabs(a[i] - b[i])));
    return largest;
}

std::string space_of(const OIIO::ImageSpec& spec)
{
    return spec.get_string_attribute("oiio:ColorSpace");
}

std::string text(const std::vector<unsigned char>& bytes)
{
    return { bytes.begin(), bytes.end() };
}

/// A whole WebP file of 16 × 12, lossless, with these chunks; `flags` of its VP8X chunk.
std::string webp_with(int channels, std::uint8_t flags, const std::string& before, const std::string& after)
{
    std::vector<std::uint8_t> values;
    for (const float value : made_pixels(channels))
        values.push_back(static_cast<std::uint8_t>(std::lround(value * 255)));
    std::uint8_t* encoded = nullptr;
    const std::size_t size = (channels == 4 ? WebPEncodeLosslessRGBA : WebPEncodeLosslessRGB)(values.data(), 16, 12,
                                                                                              16 * channels, &encoded);
    const std::string picture(reinterpret_cast<char*>(encoded) + 12, size - 12);
    WebPFree(encoded);
    const std::string body = "WEBPVP8X" + little_endian(10) + little_endian(flags) + little_endian(15, 3) +
                             little_endian(11, 3) + before + picture + after;
    return "RIFF" + little_endian(std::uint32_t(body.size())) + body;
}

std::string webp_chunk(const std::string& name, const std::string& data)
{
    return name + little_endian(std::uint32_t(data.size())) + data + std::string(data.size() & 1, '\0');
}

} // namespace

TEST_CASE("integers of every container are sRGB by name, and stay what they are")
{
    const ScratchFolder folder;
    for (const std::string ending : { "bmp", "dpx", "gif", "ico", "jpg", "png", "ppm", "sgi", "tga", "tif" }) {
        CAPTURE(ending);
        const std::string path = folder.path("photo." + ending);
        write_made(path, made_spec(3));
        const auto file = opened(path);
        CHECK(space_of(file->spec()) == "sRGB");
        const bool transparent = file->spec().alpha_channel >= 0; // GIF and ICO always are to their readers
        CHECK(file->spec().format == (transparent ? OIIO::TypeUInt16 : OIIO::TypeUInt8));
        CHECK(note_list(file->spec()).empty());
        const bool lossy = ending == "jpg" || ending == "gif";
        const std::vector<float> pixels = pixels_of(*file);
        if (file->spec().nchannels == 3 && !lossy)
            CHECK(largest_difference(pixels, made_pixels(3)) < 0.003);
        CHECK(pixels.size() == 16u * 12 * file->spec().nchannels);
    }
}

TEST_CASE("integers whose colour space nobody knows are sRGB by name, with a note")
{
    const ScratchFolder folder;
    OIIO::ImageSpec spec = made_spec(3);
    spec.attribute("oiio:ColorSpace", "KodakLog");
    write_made(folder.path("a.dpx"), spec);
    const auto file = opened(folder.path("a.dpx"));
    CHECK(space_of(file->spec()) == "sRGB");
    CHECK(note_list(file->spec()) ==
          std::vector<std::string>{ "the colour space 'KodakLog' is not known; taken as display-encoded sRGB" });
}

TEST_CASE("floats keep the name that their reader gives")
{
    const ScratchFolder folder;
    write_made(folder.path("a.exr"), made_spec(3, OIIO::TypeHalf));
    CHECK(space_of(opened(folder.path("a.exr"))->spec()) == "Linear");
    write_made(folder.path("a.tif"), made_spec(3, OIIO::TypeFloat));
    CHECK(space_of(opened(folder.path("a.tif"))->spec()) != "sRGB");
}

TEST_CASE("colour under alpha is straight where that is asked for, associated elsewhere, in every container")
{
    const ScratchFolder folder;
    const std::vector<float> stored = made_pixels(4);
    std::vector<float> associated = stored;
    for (std::size_t i = 0; i < stored.size(); ++i)
        if (i % 4 != 3)
            associated[i] *= stored[i - i % 4 + 3];
    std::vector<std::string> paths;
    for (const std::string ending : { "bmp", "dpx", "png", "sgi", "tga", "tif" }) {
        paths.push_back(folder.path("photo." + ending));
        OIIO::ImageSpec spec = made_spec(4);
        spec.attribute("oiio:UnassociatedAlpha", 1);
        write_made(paths.back(), spec);
    }
    paths.push_back(folder.path("photo.webp"));
    write_bytes(paths.back(), webp_with(4, 0x10, "", ""));
    for (const std::string& path : paths) {
        CAPTURE(path);
        const auto as_stored = opened(path, straight());
        CHECK(as_stored->spec().get_int_attribute("oiio:UnassociatedAlpha") == 1);
        CHECK(largest_difference(pixels_of(*as_stored), stored) < 0.003);
        const auto multiplied = opened(path);
        CHECK(multiplied->spec().get_int_attribute("oiio:UnassociatedAlpha") == 0);
        CHECK(largest_difference(pixels_of(*multiplied), associated) < 0.002);
    }
    // An EXR's is associated, whatever is asked for.
    write_made(folder.path("a.exr"), made_spec(4, OIIO::TypeHalf));
    const auto exr = opened(folder.path("a.exr"), straight());
    CHECK(exr->spec().get_int_attribute("oiio:UnassociatedAlpha") == 0);
    CHECK(largest_difference(pixels_of(*exr), stored) < 0.001);
}

TEST_CASE("a PNG's colour is what its specification puts first: cICP, iCCP, sRGB, gAMA with cHRM")
{
    const ScratchFolder folder;
    write_made(folder.path("plain.png"), made_spec(3));
    const std::string plain = bytes_of(folder.path("plain.png"));
    OIIO::ImageSpec with_profile = made_spec(3);
    const auto icc = adobe_rgb();
    set_icc_profile(with_profile, icc.data(), icc.size());
    write_made(folder.path("profile.png"), with_profile);
    const std::string profiled = bytes_of(folder.path("profile.png"));
    const std::size_t iccp_at = profiled.find("iCCP") - 4;
    const std::size_t iccp_size = 256 * static_cast<unsigned char>(profiled[iccp_at + 2]) +
                                  static_cast<unsigned char>(profiled[iccp_at + 3]) + 12;
    const std::string iccp = profiled.substr(iccp_at, iccp_size);
    const std::string cicp = png_chunk("cICP", { 12, 13, 0, 1 }), srgb = png_chunk("sRGB", std::string(1, '\0')),
                      gama = png_chunk("gAMA", big_endian(55556));
    std::string chrm_data;
    for (const unsigned number : { 31270u, 32900u, 64000u, 33000u, 21000u, 71000u, 15000u, 6000u })
        chrm_data += big_endian(number);
    const std::string chrm = png_chunk("cHRM", chrm_data);

    const auto spec_with = [&](const std::string& chunks) {
        const std::string path = folder.path("made.png");
        write_bytes(path, png_with(plain, chunks));
        return OIIO::ImageSpec(opened(path)->spec());
    };
    const auto has = [](const OIIO::ImageSpec& spec, const char* name) { return spec.find_attribute(name) != nullptr; };
    const OIIO::ImageSpec first = spec_with(cicp + iccp);
    CHECK(has(first, "CICP"));
    CHECK(!has(first, "ICCProfile"));
    const OIIO::ImageSpec second = spec_with(iccp + gama + chrm);
    CHECK(has(second, "ICCProfile"));
    CHECK(space_of(second) == "sRGB");
    CHECK(!has(second, "chromaticities"));
    const OIIO::ImageSpec third = spec_with(srgb + gama + chrm);
    CHECK(space_of(third) == "sRGB");
    CHECK(!has(third, "chromaticities"));
    const OIIO::ImageSpec fourth = spec_with(gama + chrm);
    CHECK(space_of(fourth) == "Gamma1.8");
    const auto* numbers = fourth.find_attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8));
    REQUIRE(numbers);
    const Chromaticities expected{ 0.64f, 0.33f, 0.21f, 0.71f, 0.15f, 0.06f, 0.3127f, 0.3290f };
    CHECK(std::equal(expected.begin(), expected.end(), static_cast<const float*>(numbers->data())));
    CHECK(space_of(spec_with(png_chunk("gAMA", big_endian(100000)))) == "Linear");
    CHECK(space_of(spec_with(png_chunk("gAMA", big_endian(0)))) == "sRGB");
    CHECK(space_of(spec_with("")) == "sRGB");
    CHECK(note_list(spec_with(png_chunk("acTL", big_endian(9) + big_endian(0)))).size() == 1);
    CHECK(spec_with(png_chunk("eXIf", made_exif(6))).get_int_attribute("Orientation") == 6);
}

TEST_CASE("WebP brings its profile and its orientation")
{
    const ScratchFolder folder;
    const std::string path = folder.path("photo.webp");
    write_bytes(path, webp_with(3, 0x28, webp_chunk("ICCP", text(adobe_rgb())), webp_chunk("EXIF", made_exif(8))));
    const auto file = opened(path);
    REQUIRE(file->spec().find_attribute("ICCProfile"));
    CHECK(file->spec().find_attribute("ICCProfile")->type().size() == adobe_rgb().size());
    CHECK(file->spec().get_int_attribute("Orientation") == 8);
    CHECK(largest_difference(pixels_of(*file), made_pixels(3)) < 0.003);
    std::string marked = bytes_of(path);
    write_bytes(path, webp_with(3, 0x08, "", webp_chunk("EXIF", std::string("Exif\0\0", 6) + made_exif(3))));
    CHECK(opened(path)->spec().get_int_attribute("Orientation") == 3);
    write_bytes(path, bytes_of(path).substr(0, 80));
    CHECK(refusal(path) == "photo: damaged or truncated");
}

TEST_CASE("the first frame of an animated WebP is taken, and a note says so")
{
    const ScratchFolder folder;
    const std::string path = folder.path("photo.webp"), still = webp_with(4, 0x10, "", "");
    const std::string picture = still.substr(still.find("VP8L"));
    const std::string frame =
        webp_chunk("ANMF", little_endian(0, 3) + little_endian(0, 3) + little_endian(15, 3) + little_endian(11, 3) +
                               little_endian(100, 3) + little_endian(2, 1) + picture);
    const std::string body = "WEBPVP8X" + little_endian(10) + little_endian(0x12) + little_endian(15, 3) +
                             little_endian(11, 3) + webp_chunk("ANIM", little_endian(0) + little_endian(0, 2)) + frame +
                             frame + frame;
    write_bytes(path, "RIFF" + little_endian(std::uint32_t(body.size())) + body);
    const auto file = opened(path, straight());
    CHECK(note_list(file->spec()) == std::vector<std::string>{ "is an animation of 3 frames; the first was taken" });
    CHECK(largest_difference(pixels_of(*file), made_pixels(4)) < 0.003);
    CHECK(!file->seek_subimage(1, 0));
}

TEST_CASE("the profile and the calibration of a BMP file are read")
{
    const ScratchFolder folder;
    const std::string path = folder.path("photo.bmp"), icc = text(adobe_rgb());
    const auto header = [&](std::uint32_t space, const std::string& calibration, std::uint32_t profile_at,
                            std::uint32_t profile_size) {
        const std::uint32_t pixels_at = 14 + 124, pixel_bytes = 16 * 12 * 3;
        return "BM" + little_endian(pixels_at + pixel_bytes + profile_size) + little_endian(0) +
               little_endian(pixels_at) + little_endian(124) + little_endian(16) + little_endian(12) +
               little_endian(1, 2) + little_endian(24, 2) + little_endian(0) + little_endian(pixel_bytes) +
               std::string(16, '\0') + std::string(16, '\0') + little_endian(space) + calibration + little_endian(4) +
               little_endian(profile_at) + little_endian(profile_size) + little_endian(0) +
               std::string(pixel_bytes, 'p');
    };
    write_bytes(path, header(0x4d424544, std::string(48, '\0'), 124 + 16 * 12 * 3, std::uint32_t(icc.size())) + icc);
    REQUIRE(opened(path)->spec().find_attribute("ICCProfile"));
    CHECK(opened(path)->spec().find_attribute("ICCProfile")->type().size() == icc.size());
    write_bytes(path, header(0x4d424544, std::string(48, '\0'), 0x7fffffff, 100));
    CHECK(note_list(opened(path)->spec()).size() == 1);
    // The XYZ of BT.709's primaries, and an exponent of 1.8.
    std::string calibration;
    for (const double xyz : { 0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805, 0.0722, 0.9505 })
        calibration += little_endian(static_cast<std::uint32_t>(xyz * (1 << 30)));
    for (int c = 0; c < 3; ++c)
        calibration += little_endian(static_cast<std::uint32_t>(1.8 * 65536));
    write_bytes(path, header(0, calibration, 0, 0));
    const OIIO::ImageSpec calibrated = opened(path)->spec();
    CHECK(space_of(calibrated) == "Gamma1.8");
    const auto* numbers = calibrated.find_attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8));
    REQUIRE(numbers);
    for (int i = 0; i < 8; ++i)
        CHECK(static_cast<const float*>(numbers->data())[i] == doctest::Approx(kSrgbChromaticities[i]).epsilon(2e-3));
}

TEST_CASE("a TIFF whose white is 0 is read as a positive of any depth, or refused")
{
    const ScratchFolder folder;
    const std::string path = folder.path("photo.tif");
    const auto tiff = [](int bits, int samples, const std::string& pixels) {
        const std::vector<std::array<std::uint32_t, 3>> tags = {
            { 256, 3, 2 },
            { 257, 3, 1 },
            { 258, 3, std::uint32_t(bits) },
            { 259, 3, 1 },
            { 262, 3, 0 },
            { 273, 4, 8 },
            { 277, 3, std::uint32_t(samples) },
            { 278, 3, 1 },
            { 279, 4, std::uint32_t(pixels.size()) },
        };
        std::string directory = little_endian(std::uint32_t(tags.size()), 2);
        for (const auto& [tag, type, value] : tags)
            directory += little_endian(tag, 2) + little_endian(type, 2) + little_endian(1) + little_endian(value);
        return std::string("II*\0", 4) + little_endian(std::uint32_t(8 + pixels.size())) + pixels + directory +
               little_endian(0);
    };
    write_bytes(path, tiff(8, 1, { '\0', '\x40' }));
    CHECK(pixels_of(*opened(path))[0] == doctest::Approx(1));
    CHECK(pixels_of(*opened(path))[1] == doctest::Approx(191 / 255.0));
    write_bytes(path, tiff(16, 1, little_endian(0, 2) + little_endian(0x4000, 2)));
    CHECK(pixels_of(*opened(path))[0] == doctest::Approx(1));
    CHECK(pixels_of(*opened(path))[1] == doctest::Approx(0xbfff / 65535.0));
}

TEST_CASE("a JPEG that lacks nothing but its end is whole, one that lacks pixels is refused")
{
    const ScratchFolder folder;
    const std::string path = folder.path("photo.jpg");
    write_made(path, made_spec(3));
    const std::string whole = bytes_of(path);
    const std::vector<float> right = pixels_of(*opened(path));
    const std::size_t tables = whole.find("\xff\xdb"), scan = whole.find("\xff\xda");
    REQUIRE(scan != std::string::npos);
    for (const std::string& bytes :
         { whole.substr(0, whole.size() - 2), whole.substr(0, tables) + "xy" + whole.substr(tables) }) {
        write_bytes(path, bytes);
        const auto file = opened(path);
        CHECK(pixels_of(*file) == right);
        REQUIRE(file->reading_notes().size() == 1);
        CHECK(file->reading_notes()[0].find("is damaged, though no pixel is missing: ") == 0);
    }
    write_bytes(path, whole.substr(0, scan + (whole.size() - scan) / 2));
    const auto cut = opened(path);
    CHECK(pixels_of(*cut).empty());
    CHECK(cut->geterror().find("photo: damaged or truncated at row 0: ") == 0);
    OIIO::ImageSpec config;
    config.attribute("srisp:allow_partial", 1);
    const auto partial = opened(path, config);
    CHECK(pixels_of(*partial).size() == right.size());
    CHECK(partial->reading_notes().at(0).find("damaged or truncated at row 0") == 0);
}

TEST_CASE("what breaks off is refused in every container, and read as far as it goes where that is allowed")
{
    const ScratchFolder folder;
    OIIO::ImageSpec config;
    config.attribute("srisp:allow_partial", 1);
    // OpenImageIO's PNG reader leaks some bytes at such a file: tests/clients/photos_test.py cuts those.
    for (const std::string ending : { "bmp", "dpx", "exr", "ppm", "sgi", "tga", "tif" }) {
        CAPTURE(ending);
        const std::string path = folder.path("photo." + ending);
        write_made(path, made_spec(3, ending == "exr" ? OIIO::TypeHalf : OIIO::TypeUInt8));
        // Targa's pixels end long before the file does.
        write_bytes(path, bytes_of(path).substr(0, bytes_of(path).size() * (ending == "tga" ? 4 : 6) / 10));
        const auto file = ImageFile::open(path, {}, "photo");
        if (file)
            CHECK(pixels_of(**file).empty());
        const auto partial = ImageFile::open(path, config, "photo");
        if (file && partial)
            CHECK(pixels_of(**partial).size() == 16u * 12 * 3);
    }
}

TEST_CASE("looking for a subimage that is not there does no harm")
{
    const ScratchFolder folder;
    write_made(folder.path("photo.tif"), made_spec(3));
    const auto file = opened(folder.path("photo.tif"));
    CHECK(!file->seek_subimage(1, 0));
    CHECK(!file->has_error());
    CHECK(largest_difference(pixels_of(*file), made_pixels(3)) < 0.003);
}

TEST_CASE("what is no image file is named")
{
    const ScratchFolder folder;
    CHECK(refusal(folder.path("missing.jpg")) == "photo: does not exist");
    CHECK(refusal(folder.path()) == "photo: is a folder");
    CHECK(refusal(folder.file("notes.txt", "some text")) == "photo: is not an image that OpenImageIO reads");
    CHECK(refusal(folder.file("photo.jpg", "some text")) == "photo: is not an image that OpenImageIO reads");
    CHECK(refusal(folder.file("empty.png", "")).find("photo: ") == 0);
}
