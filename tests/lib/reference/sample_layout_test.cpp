// SPDX-License-Identifier: Apache-2.0
// Plain samples without a header: refused, or read as a JSON file beside them says.
#include "reference/sample_layout.h"

#include <srisp/reference.h>

#include <array>
#include <cmath>
#include <functional>

#include "scratch_folder.h"
#include "shared_files.h"

using namespace srisp;

namespace {

using Site = std::function<int(int x, int y)>;

constexpr int kWidth = 64, kHeight = 48;
const char kTenBits[] = R"({"width": 64, "height": 48, "cfa": "GRBG", "bits": 10, "black": 64, "white": 1023})";

/// Of GRBG: green (0, 0), red (1, 0), blue (0, 1).
int colors(int x, int y, int red, int green, int blue)
{
    return (x & 1) == (y & 1) ? green : (x & 1) ? red : blue;
}

int site(int x, int y)
{
    return colors(x, y, 64 + 480, 64 + 240, 64 + 720);
}

std::string samples(int bytes_per_sample, const Site& value, int width = kWidth, int height = kHeight)
{
    std::string bytes;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int i = 0; i < bytes_per_sample; ++i)
                bytes += char(value(x, y) >> 8 * i & 255);
    return bytes;
}

Expected<std::shared_ptr<const Reference>> load(const std::string& bytes, const std::string& json,
                                                const std::string& layout_name = "plate.raw.json")
{
    const ScratchFolder folder;
    if (!json.empty())
        folder.file(layout_name, json);
    return load_reference(folder.file("plate.raw", bytes));
}

Reference loaded(const std::string& bytes, const std::string& json, const std::string& name = "plate.raw.json")
{
    const auto reference = load(bytes, json, name);
    REQUIRE_MESSAGE(reference, (reference ? "" : reference.error().message));
    return **reference;
}

void check_color(const Reference& reference, const std::array<double, 3>& expected)
{
    double worst = 0;
    for (std::size_t i = 0; i < reference.thumbnail.rgb.size(); ++i)
        worst = std::max(worst, std::abs(double(reference.thumbnail.rgb[i]) - expected[i % 3]));
    CHECK(worst < 2e-5);
}

const std::array<double, 3> kExpected{ 480 / 959.0, 240 / 959.0, 720 / 959.0 };

/// Why a description is refused, behind its name.
std::string refusal(const std::string& json)
{
    const auto layout = parse_sample_layout(json, "p.json");
    if (layout)
        return "(it was read)";
    const std::string start = "description 'p.json'";
    CHECK(layout.error().message.compare(0, start.size(), start) == 0);
    return layout.error().message.substr(start.size());
}

} // namespace

TEST_CASE("Samples without a header are read as the JSON beside them says, which is noted")
{
    for (const std::string name : { "plate.raw.json", "plate.json" }) {
        const Reference reference = loaded(samples(2, site), kTenBits, name);
        check_color(reference, kExpected);
        CHECK(reference.facts.width == kWidth);
        CHECK(reference.facts.height == kHeight);
        CHECK(reference.facts.cfa_pattern == "GRBG");
        CHECK(reference.facts.black_level == std::array<float, 4>{ 64, 64, 64, 64 });
        CHECK(reference.facts.white_level == 1023);
        REQUIRE(reference.notes.size() == 1);
        CHECK(reference.notes[0].find("plain samples without a header, read as '") == 0);
        CHECK(reference.notes[0].find(name + "' says") != std::string::npos);
    }
}

TEST_CASE("Camera, neutral, orientation, offset, rows with a rest, black per site: each does what it says")
{
    const std::string json = R"({"width": 64, "height": 48, "cfa": "GRBG", "bits": 12, "black": [10, 20, 30, 10],
        "white": 4000, "camera": "Acme 1", "neutral": [0.5, 2, 1], "orientation": 6, "offset": 7, "row_bytes": 130})";
    std::string bytes = "header!";
    for (int y = 0; y < kHeight; ++y)
        bytes += samples(
                     2, [y](int x, int) { return colors(x, y, 2010, 2000, 2020); }, kWidth, 1) +
                 "ab";
    const Reference reference = loaded(bytes, json);
    CHECK(reference.facts.model == "Acme 1");
    CHECK(reference.facts.as_shot_neutral == std::array<float, 3>{ 0.25f, 1, 0.5f });
    CHECK(reference.facts.orientation == 6);
    CHECK(reference.facts.black_level == std::array<float, 4>{ 20, 10, 30, 10 });
    check_color(reference, { 1990 / 3980.0, 1990 / 3990.0, 1990 / 3970.0 });
}

TEST_CASE("Eight bits are one byte a sample, and packed ones are as MIPI CSI-2 orders them")
{
    const std::string eight = R"({"width": 64, "height": 48, "cfa": "GRBG", "bits": 8, "black": 16, "white": 255})";
    const auto byte_site = [](int x, int y) { return colors(x, y, 16 + 120, 16 + 60, 16 + 180); };
    check_color(loaded(samples(1, byte_site), eight), { 120 / 239.0, 60 / 239.0, 180 / 239.0 });

    std::string ten, twelve;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; x += 4) {
            for (int i = 0; i < 4; ++i)
                ten += char(site(x + i, y) >> 2);
            ten += char((site(x, y) & 3) | (site(x + 1, y) & 3) << 2 | (site(x + 2, y) & 3) << 4 |
                        (site(x + 3, y) & 3) << 6);
        }
    const auto twelve_site = [](int x, int y) { return 4 * site(x, y) + (x & 1) + 2; };
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; x += 2) {
            twelve += char(twelve_site(x, y) >> 4);
            twelve += char(twelve_site(x + 1, y) >> 4);
            twelve += char((twelve_site(x, y) & 15) | (twelve_site(x + 1, y) & 15) << 4);
        }
    const auto json = [](const std::string& bits, const std::string& packed) {
        return R"({"width": 64, "height": 48, "cfa": "GRBG", "black": 64, "white": 1000, "bits": )" + bits + packed +
               "}";
    };
    const auto same = [&](const std::string& packed_bytes, const Site& value, const std::string& bits) {
        CHECK(loaded(packed_bytes, json(bits, R"(, "packed": "mipi")")).thumbnail.rgb ==
              loaded(samples(2, value), json(bits, R"(, "packed": "none")")).thumbnail.rgb);
    };
    same(ten, site, "10");
    same(twelve, twelve_site, "12");
}

TEST_CASE("A file of any size without header or description is refused with what to do, also where LibRaw would guess")
{
    // 1,447,680 bytes: LibRaw's table says AVT F-145C; 41,312,256: Meizu MX4, of 5248 x 3936.
    for (const int size : { 1, 40, 5000, 1447680, 41312256 }) {
        CAPTURE(size);
        const ScratchFolder folder;
        const std::string path = folder.file("plate.raw", std::string(std::size_t(size), '\x21'));
        const auto reference = load_reference(path);
        REQUIRE(!reference);
        const std::string start = "reference '" + path + "': is not a RAW file that LibRaw ";
        CHECK(reference.error().message.compare(0, start.size(), start) == 0);
        CHECK(reference.error().message.find("If it holds plain samples, describe them in '" + path +
                                             ".json': {\"width\"") != std::string::npos);
    }
}

TEST_CASE("A description that does not fit the file is refused: size, bits")
{
    const auto message = [](const std::string& bytes) {
        const auto reference = load(bytes, kTenBits);
        return reference ? std::string("(it loaded)") : reference.error().message;
    };
    const std::string right = samples(2, site);
    for (const std::string& bytes : { right + "x", right.substr(1) })
        CHECK(message(bytes).find("says 6144 bytes (offset 0, 48 rows of 128 bytes), the file has " +
                                  std::to_string(bytes.size())) != std::string::npos);
    // Big-endian samples are larger than 10 bits can say.
    CHECK(message(samples(2, [](int x, int y) {
              return site(x, y) >> 8 | (site(x, y) & 255) << 8;
          })).find("which is more than the 10 bits") != std::string::npos);
    // 65535 x 65535 x 2 bytes do not wrap around to a small number.
    const auto huge =
        load(right, R"({"width": 65535, "height": 65535, "cfa": "RGGB", "bits": 16, "black": 0, "white": 9})");
    REQUIRE(!huge);
    CHECK(huge.error().message.find("says 8589672450 bytes") != std::string::npos);
}

TEST_CASE("Descriptions are validated key by key")
{
    const auto with = [](const std::string& from, const std::string& to) {
        std::string json = kTenBits;
        json.replace(json.find(from), from.size(), to);
        return refusal(json);
    };
    CHECK(refusal("[1]") == ": the text is not a JSON object");
    CHECK(refusal("{") == ": the text is not a JSON object (line 1, column 2)");
    CHECK(refusal("{}") == " has no 'width'");
    CHECK(with("\"cfa\"", "\"cfs\"") == " has no 'cfa'");
    CHECK(with("64", "0") == " 'width' must be a whole number from 2 to 65535, has 0");
    CHECK(with("64", "64.5") == " 'width' must be a whole number from 2 to 65535, has 64.5");
    CHECK(with("48", "\"48\"") == " 'height' must be a whole number from 2 to 65535, has \"48\"");
    CHECK(with("48", "18446744073709551615") ==
          " 'height' must be a whole number from 2 to 65535, has 18446744073709551615");
    CHECK(with("GRBG", "rggb") == " 'cfa' must be RGGB, GRBG, GBRG or BGGR, has 'rggb'");
    CHECK(with("\"GRBG\"", "1") == " 'cfa' must be a string");
    CHECK(with("10", "17") == " 'bits' must be a whole number from 1 to 16, has 17");
    CHECK(with("1023", "1024") == " 'black' and 'white' must be from 0 to 1023 for 10 bits");
    CHECK(with(": 64,", ": -1,").find("'width'") != std::string::npos);
    CHECK(with("\"black\": 64", "\"black\": -1") == " 'black' and 'white' must be from 0 to 1023 for 10 bits");
    CHECK(with("\"black\": 64", "\"black\": [1, 2]") == " 'black' must be one number or four, has [1,2]");
    CHECK(with("\"black\": 64", "\"black\": []") == " 'black' must be one number or four, has []");
    CHECK(with("\"black\": 64", "\"black\": null") == " 'black' must hold finite numbers, has null");
    CHECK(with("1023", "64") == " has levels that cannot be: black level 64 is not below white level 64");
    CHECK(with("}", ", \"widht\": 3}") == " has an unknown key 'widht'; did you mean 'width'?");
    CHECK(with("}", ", \"packed\": \"mipy\"}") == " has an unknown value 'mipy' of 'packed'; did you mean 'mipi'?");
    CHECK(with("10", "14, \"packed\": \"mipi\"") == " 'packed': 'mipi' needs 10 or 12 bits, has 14");
    CHECK(with("64", "66, \"packed\": \"mipi\"") ==
          " 'width' of 66 must be a multiple of 4 for packed samples of 10 bits");
    CHECK(with("}", ", \"row_bytes\": 127}") == " 'row_bytes' must be a whole number from 128 to 2147483648, has 127");
    CHECK(with("}", ", \"offset\": -1}") == " 'offset' must be a whole number from 0 to 2147483648, has -1");
    CHECK(with("}", ", \"orientation\": 9}") == " 'orientation' must be a whole number from 1 to 8, has 9");
    CHECK(with("}", ", \"neutral\": [1, 0, 1]}") ==
          " 'neutral' must be three numbers above 0: the camera's R, G, B of a neutral surface");
    CHECK(with("}", ", \"camera\": 5}") == " 'camera' must be a string");
    CHECK(with("}", ", \"bits\": 5}").find("'bits' appears twice") != std::string::npos);
}

TEST_CASE(
    "A described file that begins like a BMP is read as described where it is called RAW, and files with a header "
    "do not look beside them")
{
    std::string bytes = samples(2, [](int x, int y) { return site(x, y); });
    const std::string sixteen = R"({"width": 64, "height": 48, "cfa": "GRBG", "bits": 16, "black": 64, "white": 1023})";
    bytes[0] = 'B';
    bytes[1] = 'M';
    CHECK(load(bytes, sixteen));
    const auto photo = load(bytes, "");
    REQUIRE(!photo);
    CHECK(photo.error().message.find("is a BMP file") != std::string::npos);

    const ScratchFolder folder;
    folder.file("a.x3f.json", "{}");
    const auto foveon = load_reference(folder.file("a.x3f", "FOVb" + std::string(500, '\0')));
    REQUIRE(!foveon);
    CHECK(foveon.error().message.find("Foveon") != std::string::npos);
}

TEST_CASE("A changed description gives another state, another reference from the cache and another hash")
{
    const ScratchFolder folder;
    const std::string path = folder.file("plate.raw", samples(2, site));
    folder.file("plate.raw.json", kTenBits);
    const std::string state = reference_state(path);
    const auto first = load_reference_cached(path);
    REQUIRE(first);
    CHECK(load_reference_cached(path)->get() == first->get());
    CHECK(reference_state(path) == state);

    folder.file("plate.raw.json",
                R"({"width": 64, "height": 48, "cfa": "RGGB", "bits": 10, "black": 0, "white": 1000})");
    CHECK(reference_state(path) != state);
    const auto second = load_reference_cached(path);
    REQUIRE(second);
    CHECK((*second)->facts.cfa_pattern == "RGGB");
    CHECK((*second)->hash != (*first)->hash);

    std::filesystem::remove(folder.path("plate.raw.json"));
    CHECK(!load_reference_cached(path));
}
