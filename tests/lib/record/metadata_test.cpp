// SPDX-License-Identifier: Apache-2.0
#include <srisp/metadata.h>

#include <cstdio>
#include <filesystem>

#include <OpenImageIO/imagebuf.h>
#include <unistd.h>

#include "record/record.h"
#include "shared_files.h"

using namespace srisp;

namespace {

Parameters some_parameters()
{
    Parameters p;
    for (auto& weights : p.tone_weights)
        weights = { 0.1f, 0.2f, 0.3f, 0.15f, 0.25f };
    p.gamma_weights = p.color_weights = p.white_balance_weights = p.gain_weights = { 1, 0, 0, 0, 0 };
    p.gamma = 2.3456789f;
    p.color = { 1.7f, -0.5f, -0.2f, -0.3f, 1.6f, -0.3f, 0.01f, -0.71f, 1.7f };
    p.white_balance = { 2.0123457f, 1, 1.51f };
    p.gain = 0.7654321f;
    p.model_name = "default";
    p.model_hash = "xxh128:00112233445566778899aabbccddeeff";
    p.reference_name = "réf \"1\" {a}.dng";
    p.reference_hash = "xxh128:ffeeddccbbaa99887766554433221100";
    return p;
}

CameraFacts some_camera()
{
    CameraFacts camera;
    camera.make = "Canon";
    camera.model = "EOS 5D";
    camera.iso = 200;
    camera.white_level = 4095;
    camera.as_shot_neutral = { 0.5f, 1, 0.7f };
    camera.noise_profile = { 1e-4, 1e-6 };
    CameraFacts::ColorMatrix tungsten, daylight;
    tungsten.xyz_to_camera = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    tungsten.illuminant = 17;
    daylight.xyz_to_camera = { 0.6347f, -0.0479f, -0.0972f, -0.8297f, 1.5954f, 0.248f, -0.1968f, 0.2131f, 0.7649f };
    daylight.illuminant = 21;
    camera.color_matrices = { tungsten, daylight };
    return camera;
}

OIIO::ImageSpec photo_spec()
{
    OIIO::ImageSpec spec(8, 6, 3, OIIO::TypeFloat);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("Exif:ColorSpace", 1);
    spec.attribute("oiio:Gamma", 2.2f);
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, 4), "icc");
    spec.attribute("ICCProfile:profile_description", "Display P3");
    spec.attribute("oiio:SHA-1", "1234");
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), std::vector<float>(8, 0.3f).data());
    spec.attribute("ImageDescription", "my cat");
    spec.attribute("Make", "Apple");
    spec.attribute("ExposureTime", 0.01f);
    spec.attribute("Orientation", 6);
    return spec;
}

/// A folder of its own that goes away.
struct TemporaryFolder {
    std::filesystem::path path = std::filesystem::temp_directory_path() / ("srisp-test-" + std::to_string(::getpid()));
    TemporaryFolder() { std::filesystem::create_directories(path); }
    ~TemporaryFolder() { std::filesystem::remove_all(path); }
};

/// Through a real file, with the writer's defaults.
OIIO::ImageSpec written_and_read(const OIIO::ImageSpec& spec, const std::string& extension, OIIO::TypeDesc type)
{
    const TemporaryFolder folder;
    const std::string file = (folder.path / ("result." + extension)).string();
    OIIO::ImageBuf image(spec);
    REQUIRE(image.write(file, type));
    auto input = OIIO::ImageInput::open(file);
    REQUIRE(input);
    return input->spec();
}

} // namespace

TEST_CASE("parameters survive EXR, TIFF, PNG and JPEG to the bit")
{
    const CameraFacts camera = some_camera();
    OIIO::ImageSpec spec = photo_spec();
    record_result(spec, some_parameters(), &camera, Direction::reverse);
    const std::pair<const char*, OIIO::TypeDesc> formats[] = {
        { "exr", OIIO::TypeHalf },  { "exr", OIIO::TypeFloat },  { "tif", OIIO::TypeUInt16 },
        { "tif", OIIO::TypeFloat }, { "png", OIIO::TypeUInt16 }, { "jpg", OIIO::TypeUInt8 }
    };
    for (const auto& [extension, type] : formats) {
        INFO(extension << " " << type);
        const OIIO::ImageSpec read = written_and_read(spec, extension, type);
        const auto parameters = recorded_parameters(read, extension);
        REQUIRE_MESSAGE(bool(parameters), parameters.error().message);
        CHECK(to_json(*parameters) == to_json(some_parameters()));
        CHECK(is_unprocessed(read));
        CHECK(read.get_string_attribute("ImageDescription").find("synthetic") != std::string::npos);
        CHECK(!read.find_attribute("ICCProfile"));
    }
}

TEST_CASE("EXR also keeps the camera's facts, the name of the colour space and what is neutral")
{
    const CameraFacts camera = some_camera();
    OIIO::ImageSpec spec = photo_spec();
    record_result(spec, some_parameters(), &camera, Direction::reverse);
    const OIIO::ImageSpec read = written_and_read(spec, "exr", OIIO::TypeHalf);
    CHECK(read.get_string_attribute("unprocess:colorspace") == kCameraColorSpace);
    CHECK(read.get_string_attribute("unprocess:synthetic").find("synthetic RAW-like image") == 0);
    CHECK(read.get_string_attribute("unprocess:reference_model") == "EOS 5D");
    CHECK(read.get_string_attribute("unprocess:reference_hash") == some_parameters().reference_hash);
    CHECK(read.get_string_attribute("unprocess:model") == "default");
    const auto* matrix = read.find_attribute("unprocess:xyz_to_camera");
    REQUIRE(matrix);
    CHECK(matrix->get<float>() == 0.6347f); // daylight's, though it comes second
    CHECK(read.get_int_attribute("unprocess:xyz_to_camera_illuminant") == 21);
    const auto* neutral = read.find_attribute("adoptedNeutral");
    REQUIRE(neutral);
    // camera neutral (1/2.0123, 1, 1/1.51) through the inverse of that matrix
    const float* xy = static_cast<const float*>(neutral->data());
    CHECK(xy[0] == doctest::Approx(0.34821).epsilon(1e-4));
    CHECK(xy[1] == doctest::Approx(0.35614).epsilon(1e-4));
    CHECK(read.get_string_attribute("Make") == "Apple");
    CHECK(read.get_int_attribute("Orientation") == 6);
}

TEST_CASE("what described the photo's encoding is gone, its other words stay")
{
    OIIO::ImageSpec spec = photo_spec();
    record_result(spec, some_parameters(), nullptr, Direction::reverse);
    for (const char* gone : { "ICCProfile", "ICCProfile:profile_description", "Exif:ColorSpace", "oiio:Gamma",
                              "oiio:SHA-1", "chromaticities", "adoptedNeutral" })
        CHECK_MESSAGE(!spec.find_attribute(gone), gone);
    CHECK(spec.get_string_attribute("oiio:ColorSpace") == "camera_rgb");
    const auto record = find_record(spec.get_string_attribute("ImageDescription"));
    REQUIRE(record);
    CHECK(record->description == "my cat");
    CHECK(spec.get_float_attribute("ExposureTime") == 0.01f);
}

TEST_CASE("a forward result is sRGB, synthetic, and not RAW-like")
{
    OIIO::ImageSpec spec = photo_spec();
    const CameraFacts camera = some_camera();
    record_result(spec, some_parameters(), &camera, Direction::reverse);
    record_result(spec, some_parameters(), nullptr, Direction::forward);
    CHECK(!is_unprocessed(spec));
    CHECK(spec.get_string_attribute("oiio:ColorSpace") == "sRGB");
    CHECK(spec.get_string_attribute("ImageDescription").find("synthetic") != std::string::npos);
    CHECK(!spec.find_attribute("unprocess:xyz_to_camera"));
    CHECK(!spec.find_attribute("unprocess:colorspace"));
    const auto record = find_record(spec.get_string_attribute("ImageDescription"));
    REQUIRE(record);
    CHECK(record->description == "my cat");
}

TEST_CASE("the record is found in a caption to which programs have added")
{
    OIIO::ImageSpec spec = photo_spec();
    record_result(spec, some_parameters(), nullptr, Direction::reverse);
    const std::string line = spec.get_string_attribute("ImageDescription");
    OIIO::ImageSpec texture(8, 6, 3, OIIO::TypeFloat);
    texture.attribute("ImageDescription", "a {texture} " + line + " oiio:SHA-1=00ff oiio:AverageColor=1,2,3");
    CHECK(bool(recorded_parameters(texture, "texture.exr")));
    CHECK(is_unprocessed(texture));
}

TEST_CASE("images without a record, or with a damaged one, say so")
{
    const auto none = recorded_parameters(photo_spec(), "cat.jpg");
    REQUIRE(!none);
    CHECK(none.error().message.find("cat.jpg: holds no recorded parameters") == 0);
    CHECK(!is_unprocessed(photo_spec()));
    OIIO::ImageSpec spec = photo_spec();
    record_result(spec, some_parameters(), nullptr, Direction::reverse);
    std::string line = spec.get_string_attribute("ImageDescription");
    OIIO::ImageSpec damaged(8, 6, 3, OIIO::TypeFloat);
    damaged.attribute("ImageDescription", line.substr(0, line.size() / 2));
    CHECK(!recorded_parameters(damaged, "half.jpg"));
    line.replace(line.find("\"gain\":"), 7, "\"gian\":");
    damaged.attribute("ImageDescription", line);
    const auto misspelt = recorded_parameters(damaged, "edited.jpg");
    REQUIRE(!misspelt);
    CHECK(misspelt.error().message.find("edited.jpg: recorded parameters") != std::string::npos);
    CHECK(misspelt.error().message.find("'gain'") != std::string::npos);
}

TEST_CASE("a header without parameters still says what the image is")
{
    OIIO::ImageSpec spec = photo_spec();
    mark_result(spec, Direction::reverse);
    CHECK(is_unprocessed(spec));
    CHECK(!recorded_parameters(spec, "x"));
    CHECK(spec.get_string_attribute("oiio:ColorSpace") == "camera_rgb");
}

TEST_CASE("a photo whose caption holds a nested, doubled or broken record is a photo without one")
{
    const std::string deep = std::string(100000, '['), end = std::string(100000, ']');
    const std::vector<std::string> captions = { R"({"srisp":)" + deep,
                                                R"({"srisp":)" + deep + end + "}",
                                                R"({"srisp":"x","parameters":)" + deep + end + "}",
                                                R"({"srisp":"x","direction":"reverse","direction":"reverse"})",
                                                R"({"srisp":})",
                                                R"({"srisp":"x)" };
    for (const std::string& caption : captions) {
        OIIO::ImageSpec spec = photo_spec();
        spec.attribute("ImageDescription", caption);
        spec.attribute("unprocess:record", caption);
        CHECK(!is_unprocessed(spec));
        CHECK(recorded_parameters(spec, "p.jpg").error().message.find("p.jpg: holds no recorded parameters") == 0);
        record_result(spec, some_parameters(), nullptr, Direction::reverse);
        CHECK(bool(recorded_parameters(spec, "raw.exr")));
        const auto record = find_record(spec.get_string_attribute("ImageDescription"));
        REQUIRE(record);
        CHECK(record->description == caption); // the photo's own words, whatever they are
    }
}

TEST_CASE("levels that a user sets count in whatever type a host gives them")
{
    OIIO::ImageSpec spec(4, 4, 1, OIIO::TypeUInt16);
    const auto black = [&] { return recorded_sensor_values(spec).black_level; };
    spec.attribute("unprocess:black_level", 0.125f);
    CHECK(black() == std::array<float, 4>{ 0.125f, 0.125f, 0.125f, 0.125f });
    spec.attribute("unprocess:black_level", "0.5,0.25,0.5,0.125");
    CHECK(black() == std::array<float, 4>{ 0.5f, 0.25f, 0.5f, 0.125f });
    const int whole[4] = { 0, 1, 0, 1 };
    spec.attribute("unprocess:black_level", OIIO::TypeDesc(OIIO::TypeDesc::INT, 4), whole);
    CHECK(black() == std::array<float, 4>{ 0, 1, 0, 1 });
    spec.attribute("unprocess:black_level", "1,2,3");
    CHECK(black() == std::array<float, 4>{});
    spec.attribute("unprocess:noise_profile", "0.5,0.25");
    CHECK(recorded_sensor_values(spec).noise_profile == std::vector<double>{ 0.5, 0.25, 0.5, 0.25, 0.5, 0.25 });
}
