// SPDX-License-Identifier: Apache-2.0
// DNGs whose image data are lossy JPEGs, made here with libjpeg.
#include <srisp/noise.h>
#include <srisp/reference.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <jpeglib.h>

#include "jpeg/jpeg_data.h"
#include "lib/reference/loaded_dng.h"
#include "reference/dng_curves.h"
#include "shared_files.h"

using namespace srisp;

namespace {

using T = SyntheticDng;
using Value = std::function<int(int x, int y, int sample)>;

/// A JPEG of the best quality, whose origin is at (x0, y0) of what `value` gives.
std::string jpeg(int x0, int y0, int width, int height, int samples, const Value& value)
{
    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &bytes, &size);
    info.image_width = JDIMENSION(width);
    info.image_height = JDIMENSION(height);
    info.input_components = samples;
    info.in_color_space = samples == 3 ? JCS_RGB : JCS_GRAYSCALE;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, 100, TRUE);
    info.comp_info[0].h_samp_factor = info.comp_info[0].v_samp_factor = 1;
    jpeg_start_compress(&info, TRUE);
    for (int y = 0; y < height; ++y) {
        std::vector<JSAMPLE> row;
        for (int x = 0; x < width; ++x)
            for (int s = 0; s < samples; ++s)
                row.push_back(JSAMPLE(value(x0 + x, y0 + y, s)));
        JSAMPROW rows[] = { row.data() };
        jpeg_write_scanlines(&info, rows, 1);
    }
    jpeg_finish_compress(&info);
    std::string result(reinterpret_cast<char*>(bytes), size);
    jpeg_destroy_compress(&info);
    std::free(bytes);
    return result;
}

/// Makes the pixels of a DNG tiles of lossy JPEG.
SyntheticDng& tile(SyntheticDng& dng, int size, int samples, const Value& value)
{
    std::vector<double> offsets, counts;
    dng.pixels.clear();
    for (int y = 0; y < dng.height; y += size)
        for (int x = 0; x < dng.width; x += size) {
            const std::string bytes = jpeg(x, y, size, size, samples, value);
            offsets.push_back(double(dng.pixels.size()));
            counts.push_back(double(bytes.size()));
            dng.pixels += bytes;
        }
    dng.set(259, T::kShort, { 34892 }).set(258, T::kShort, std::vector<double>(std::size_t(samples), 8));
    dng.set(322, T::kLong, { double(size) }).set(323, T::kLong, { double(size) });
    dng.set(324, T::kLong, offsets).set(325, T::kLong, counts);
    const std::size_t start = dng.bytes().size() - dng.pixels.size();
    for (double& offset : offsets)
        offset += double(start);
    return dng.set(324, T::kLong, offsets);
}

/// The stored value v stands for (v / 255)²: steep enough that a forgotten table shows.
std::vector<double> square_table()
{
    std::vector<double> table;
    for (int v = 0; v < 256; ++v)
        table.push_back(std::round(65535.0 * v * v / (255.0 * 255.0)));
    return table;
}

double squared(double v)
{
    return v * v / (255.0 * 255.0);
}

void append(std::vector<double>& bytes, std::uint64_t value, int count)
{
    for (int i = count; i-- > 0;)
        bytes.push_back(double(value >> 8 * i & 255));
}

/// MapPolynomial of one plane over the whole image.
void append_polynomial(std::vector<double>& list, int plane, const std::vector<double>& coefficients)
{
    append(list, 8, 4);
    append(list, 0x01040000, 4);
    append(list, 0, 4);
    append(list, 36 + 8 * coefficients.size(), 4);
    for (const int area : { 0, 0, 10000, 10000, plane, 1, 1, 1 })
        append(list, std::uint64_t(area), 4);
    append(list, coefficients.size() - 1, 4);
    for (const double c : coefficients) {
        std::uint64_t bits;
        std::memcpy(&bits, &c, 8);
        append(list, bits, 8);
    }
}

void check_pixel(const Reference& reference, int x, int y, const std::array<double, 3>& expected, double tolerance)
{
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(std::abs(double(reference.thumbnail.view().pixel(x, y)[c]) - expected[c]) <= tolerance);
}

} // namespace

TEST_CASE("A lossy DNG of several tiles becomes linear by its LinearizationTable, each tile at its place")
{
    SyntheticDng dng;
    dng.resize(80, 48).linear().set(50712, T::kShort, square_table()).set(50714, T::kShort, { 0, 0, 0 });
    // The colours change at 40 and 24, within tiles of 32.
    tile(dng, 32, 3, [](int x, int y, int s) { return (x < 40 ? 100 : 200) + (y < 24 ? 0 : 20) + 10 * s; });
    const Reference reference = loaded(dng);
    CHECK(reference.facts.width == 80);
    CHECK(reference.facts.cfa_pattern.empty());
    CHECK(reference.notes.empty());
    for (const auto& [x, y, value] :
         { std::tuple(20, 20, 100), std::tuple(230, 20, 200), std::tuple(20, 230, 120), std::tuple(230, 230, 220) })
        check_pixel(reference, x, y, { squared(value), squared(value + 10), squared(value + 20) }, 0.02);
}

TEST_CASE("A lossy DNG in one strip, is the same by compression 7 and 34892")
{
    SyntheticDng dng;
    dng.resize(48, 40).linear().set(50712, T::kShort, square_table()).set(258, T::kShort, { 8, 8, 8 });
    dng.set(50714, T::kShort, { 0 });
    dng.pixels = jpeg(0, 0, 48, 40, 3, [](int, int, int s) { return 120 + 40 * s; });
    for (const double compression : { 7, 34892 })
        check_pixel(loaded(dng.set(259, T::kShort, { compression })), 128, 128,
                    { squared(120), squared(160), squared(200) }, 0.01);
}

TEST_CASE("The curves of OpcodeList2 are applied after black and white, which Adobe's converter needs")
{
    std::vector<double> list;
    append(list, 3, 4);
    append_polynomial(list, 0, { 0, 0, 1 });    // x²
    append_polynomial(list, 1, { 0.25, 0.5 });  // 1/4 + x/2
    append_polynomial(list, 2, { 0, 0, 0, 1 }); // x³
    SyntheticDng dng;
    dng.resize(32, 32).linear().set(50714, T::kShort, { 20, 20, 20 }).set(50717, T::kShort, { 220, 220, 220 });
    dng.set(51009, T::kByte, list);
    tile(dng, 16, 3, [](int, int, int) { return 120; });
    const Reference reference = loaded(dng);
    CHECK(reference.notes.empty());
    CHECK(reference.facts.white_level == 220);
    CHECK(reference.facts.black_level[0] == 20);
    check_pixel(reference, 128, 128, { 0.25, 0.5, 0.125 }, 0.006);

    append(list, 9, 4); // GainMap
    append(list, 0x01030000, 4);
    append(list, 0, 4);
    append(list, 0, 4);
    list[3] = 4;
    dng.set(51009, T::kByte, list);
    tile(dng, 16, 3, [](int, int, int) { return 120; });
    const Reference more = loaded(dng);
    check_pixel(more, 128, 128, { 0.25, 0.5, 0.125 }, 0.006);
    CHECK(more.notes == std::vector<std::string>{ "OpcodeList2 of the DNG has more than curves (gain maps and other "
                                                  "corrections), which was ignored" });
}

TEST_CASE("A lossy mosaic is read, and a lossy DNG without any curve is taken as linear, with a note")
{
    const int colors[] = { 60, 120, 200 };
    SyntheticDng dng;
    dng.resize(64, 48).set(50717, T::kShort, { 255 }).set(50714, T::kShort, { 0 });
    tile(dng, 32, 1, [&](int x, int y, int) { return colors[(x & 1) + (y & 1)]; });
    const ScratchFolder folder;
    const auto file = load_reference(folder.file("lossy.dng", dng.bytes()));
    REQUIRE(file);
    const Reference& reference = **file;
    CHECK(reference.facts.cfa_pattern == "RGGB");
    CHECK(reference_noise(reference).error().message ==
          "reference '" + reference.path +
              "': no NoiseProfile, and noise cannot be estimated from it: its lossy compression has taken noise away");
    check_pixel(reference, 128, 128, { 60 / 255.0, 120 / 255.0, 200 / 255.0 }, 0.01);
    CHECK(reference.notes ==
          std::vector<std::string>{ "the lossy DNG states no curve: its values were taken as linear" });
}

TEST_CASE("Lossy DNGs that are damaged, cut or of other JPEGs than their tags say are refused")
{
    SyntheticDng dng;
    dng.resize(64, 64).linear();
    const Value value = [](int x, int y, int s) { return (x * 7 + y * 13 + s * 50) % 256; };
    tile(dng, 32, 3, value);
    const std::string whole = dng.bytes();
    CHECK(refusal(whole.substr(0, whole.size() - 100)).find("truncated: image data end at byte") == 0);

    std::string damaged = whole;
    const std::size_t last = whole.rfind("\xff\xd8\xff");
    std::fill(damaged.begin() + std::ptrdiff_t(last), damaged.begin() + std::ptrdiff_t(last) + 3, '\0');
    CHECK(refusal(damaged) == "damaged lossy DNG: no lossy JPEG of 8 bits at x 32, y 32");
    damaged = whole;
    std::fill(damaged.end() - 600, damaged.end() - 2, '\xff');
    CHECK(refusal(damaged).find("damaged lossy DNG, JPEG at x 32, y 32: ") == 0);

    SyntheticDng other = dng;
    tile(other, 32, 3, value).set(322, T::kLong, { 16 });
    CHECK(refusal(other.bytes()) == "lossy DNG with 4 tiles or strips of 16 x 32 pixels where it needs 8");
    tile(other, 32, 3, value).set(322, T::kLong, { 60 }).set(323, T::kLong, { 60 });
    CHECK(refusal(other.bytes()) ==
          "lossy DNG whose JPEG at x 0, y 0 has 32 x 32 pixels of 3 samples where its tags say 60 x 60 of 3");

    const double start = double(whole.size() - dng.pixels.size()), all = double(dng.pixels.size());
    other = dng;
    other.set(324, T::kLong, std::vector<double>(4, start)).set(325, T::kLong, std::vector<double>(4, all));
    CHECK(refusal(other.bytes()).find("DNG whose tiles or strips overlap: they have ") == 0);

    std::string lossless = whole;
    for (std::size_t at = 0; (at = lossless.find("\xff\xc0", at)) != std::string::npos; ++at)
        lossless[at + 1] = '\xc3';
    CHECK(refusal(lossless) ==
          "lossy DNG whose JPEGs have process 3 and 8 bits: only lossy ones of 8 bits are supported");
    CHECK(refusal(dng.set(259, T::kShort, { 52546 }).bytes()) ==
          "DNG compressed by JPEG XL: not supported; convert it to a DNG without it");
}

TEST_CASE("The header of a JPEG is found behind other segments and fill bytes, and not in other bytes")
{
    const std::string head("\xff\xd8\xff\xe0\0\4ab\xff\xff\xc1\0\x11\x0c\0\x10\0\x20\1\0\0\0\0\0\0\0", 26);
    const auto* bytes = reinterpret_cast<const unsigned char*>(head.data());
    const auto header = jpeg_header(bytes, head.size());
    REQUIRE(header);
    CHECK(header->process == 1);
    CHECK(header->bits == 12);
    CHECK(header->width == 32);
    CHECK(header->height == 16);
    CHECK(header->components == 1);
    for (std::size_t size = 0; size < 19; ++size)
        CHECK(!jpeg_header(bytes, size));
    CHECK(!jpeg_header(bytes + 1, head.size() - 1));
}

TEST_CASE("Damaged opcode lists give no curves, and say so")
{
    CHECK(DngCurves("").complete());
    CHECK(DngCurves("").empty());
    for (const std::string& list :
         { std::string("\0\0", 2), std::string("\0\0\0\1", 4), std::string("\0\0\0\1\0\0\0\10", 8),
           std::string("\0\0\0\1\0\0\0\10\0\0\0\0\0\0\0\0\xff\xff\xff\xff", 20) }) {
        CHECK(DngCurves(list).empty());
        CHECK(!DngCurves(list).complete());
    }
}

TEST_CASE("Of a list of curves without end the first 64 are taken, in no more memory than these need")
{
    std::vector<double> numbers;
    const int count = 200'000; // tables of 48 GiB
    append(numbers, count, 4);
    for (int i = 0; i < count; ++i) {
        append(numbers, 7, 4);
        append(numbers, 0, 8);
        append(numbers, 36 + 2, 4);
        for (const int area : { 0, 0, 10, 10, 0, 1, 1, 1 })
            append(numbers, std::uint64_t(area), 4);
        append(numbers, 1, 4);
        append(numbers, 65535, 2);
    }
    const DngCurves curves(std::string(numbers.begin(), numbers.end()));
    CHECK(!curves.complete());
    CHECK(!curves.empty());
}

TEST_CASE("A map table of 16 bits is applied to its area and planes, and goes on with its last entry")
{
    std::vector<double> numbers;
    append(numbers, 1, 4);
    append(numbers, 7, 4);
    append(numbers, 0, 8);
    append(numbers, 36 + 4, 4);
    for (const int area : { 1, 0, 2, 10, 1, 1, 1, 2 }) // row 1, every other column, plane 1
        append(numbers, std::uint64_t(area), 4);
    append(numbers, 2, 4);
    append(numbers, 0, 2);
    append(numbers, 65535, 2);
    const DngCurves curves(std::string(numbers.begin(), numbers.end()));
    CHECK(curves.complete());
    std::vector<float> row = { 0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f };
    curves.apply(0, 2, 3, row.data());
    CHECK(row == std::vector<float>(6, 0.5f));
    curves.apply(1, 2, 3, row.data());
    CHECK(row == std::vector<float>{ 0.5f, 1, 0.5f, 0.5f, 0.5f, 0.5f });
}

TEST_CASE("A lossy linear DNG of outside trials is what it was made from")
{
    SKIP_WITHOUT_SHARED("cases/dng_lossy_jpeg_linear.dng");
    const auto reference = load_reference(shared_file("cases/dng_lossy_jpeg_linear.dng"));
    REQUIRE_MESSAGE(reference, (reference ? "" : reference.error().message));
    // Its table is v^2.2. LibRaw ignores it, takes sRGB's curve, and gives 0.342, 0.396, 0.340.
    const std::array<double, 3> expected{ 0.347, 0.403, 0.346 };
    std::array<double, 3> sums{};
    for (std::size_t i = 0; i < (*reference)->thumbnail.rgb.size(); ++i)
        sums[i % 3] += double((*reference)->thumbnail.rgb[i]);
    for (std::size_t c = 0; c < 3; ++c)
        CHECK(std::abs(sums[c] * 3 / double((*reference)->thumbnail.rgb.size()) - expected[c]) < 6e-4);
}
