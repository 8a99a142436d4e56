// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <srisp/noise.h>

#include "dng/dng_writer.h"
#include "lib/reference/synthetic_dng.h"
#include "noise/file_noise.h"
#include "seed_folder.h"
#include "ultra_hdr_jpeg.h"

using namespace srisp;
using T = SyntheticDng;

namespace {

int noise(int x, int y, int s)
{
    return (x * 7919 + y * 104729 + s * 31) % 65536;
}

void add_raw(const SeedFolder& seeds, const std::string& target, const std::string& name, const std::string& bytes)
{
    for (const std::string& one :
         { target, std::string("raw_formats"), std::string("raw_preview"), std::string("tiff_tags") })
        seeds.add(one, name, bytes);
}

void make_integers(const SeedFolder& seeds)
{
    SyntheticDng plain, levels, linear, big;
    plain.resize(24, 22);
    big.resize(24, 22).big_endian = true;
    levels.resize(24, 22)
        .set(50829, T::kLong, { 0, 0, 22, 24 })
        .set(50713, T::kShort, { 2, 2 })
        .set(50714, T::kRational, { 1, 2, 3, 4 })
        .set(50712, T::kShort, { 0, 100, 1000 })
        .set(50715, T::kSRational, std::vector<double>(24, 1))
        .set(50716, T::kSRational, std::vector<double>(22, 1))
        .set(274, T::kShort, { 6 })
        .set(51041, T::kDouble, { 1e-4, 1e-7 })
        .set(50721, T::kSRational, { 1, 0, 0, 0, 1, 0, 0, 0, 1 })
        .set(50728, T::kRational, { 0.5, 1, 0.6 });
    linear.resize(24, 22).linear();
    add_raw(seeds, "dng_levels", "plain", plain.fill(noise).bytes());
    add_raw(seeds, "dng_levels", "big", big.fill(noise).bytes());
    add_raw(seeds, "dng_levels", "levels", levels.fill(noise).bytes());
    add_raw(seeds, "dng_levels", "linear", linear.fill(noise, 3).bytes());
}

void make_floats(const SeedFolder& seeds)
{
    const int width = 24, height = 22;
    SyntheticDng floats;
    floats.resize(width, height).linear().fill_float([](int x, int y, int s) { return float(x + y + s) / 80; }, 3);
    add_raw(seeds, "float_dng", "plain", floats.bytes());
    std::vector<float> values(std::size_t(width * height * 3));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = float(i % 97) / 96;
    DngImage image;
    image.width = width;
    image.height = height;
    image.planes = 3;
    image.floats = values.data();
    image.row_stride = width * 3;
    for (const int bits : { 16, 32 }) {
        DngOptions options;
        options.bits = bits;
        options.compression = DngCompression::deflate;
        options.threads = 1;
        MemorySink sink;
        if (write_dng(sink, image, options))
            add_raw(seeds, "float_dng", "deflate" + std::to_string(bits), sink.bytes());
    }
}

void make_compressed(const SeedFolder& seeds)
{
    std::vector<std::uint16_t> values(32 * 24);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = std::uint16_t(i * 37);
    DngImage image;
    image.width = 32;
    image.height = 24;
    image.shorts = values.data();
    image.row_stride = 32;
    image.cfa_pattern = "RGGB";
    image.facts.make = "Maker";
    for (const DngCompression compression : { DngCompression::lossless, DngCompression::none }) {
        DngOptions options;
        options.compression = compression;
        options.bits = 16;
        options.threads = 1;
        MemorySink sink;
        if (write_dng(sink, image, options))
            add_raw(seeds, "raw_formats", compression == DngCompression::none ? "none" : "lossless", sink.bytes());
    }
    const std::string jpeg = jpeg_of(32, 24, 3, [](int x, int y, int c) { return (x * 7 + y * 3 + c * 50) % 256; });
    SyntheticDng lossy;
    lossy.resize(32, 24)
        .linear()
        .set(258, T::kShort, { 8, 8, 8 })
        .set(259, T::kShort, { 34892 })
        .set(50717, T::kLong, { 255, 255, 255 });
    lossy.pixels = jpeg;
    add_raw(seeds, "lossy_dng", "linear", lossy.bytes());
    const std::string curve =
        literal("\0\0\0\1\0\0\0\7\1\3\0\0\0\0\0\0\0\0\0\x2c"
                "\0\0\0\0\0\0\0\0\0\0\0\x18\0\0\0\x20\0\0\0\0\0\0\0\3\0\0\0\1\0\0\0\1\0\0\0\2\0\0\x80\0");
    std::vector<double> opcodes;
    for (const char c : curve)
        opcodes.push_back(double(static_cast<unsigned char>(c)));
    lossy.set(51009, T::kByte, opcodes);
    add_raw(seeds, "lossy_dng", "curves", lossy.bytes());
    seeds.add("lossy_dng", "opcodes", curve);
}

/// The first bytes of formats that LibRaw knows, before nothing that it can decode.
void make_heads(const SeedFolder& seeds)
{
    const std::string rest(200, '\0');
    for (const auto& [name, head] : { std::pair<const char*, std::string>{ "fuji", "FUJIFILMCCD-RAW 0201FF383501" },
                                      { "minolta", literal("\0MRM\0\0\0\x40\0PRD\0\0\0\x18") },
                                      { "canon", literal("II\x1a\0\0\0HEAPCCDR") },
                                      { "cr3", literal("\0\0\0\x18"
                                                       "ftypcrx \0\0\0\1crx isom") },
                                      { "panasonic", literal("IIU\0\x18\0\0\0") },
                                      { "olympus", literal("IIRO\x8\0\0\0") },
                                      { "sigma", "FOVb" } })
        for (const char* target : { "raw_formats", "raw_preview" })
            seeds.add(target, name, head + rest);
}

} // namespace

void make_raw_seeds(const SeedFolder& seeds)
{
    make_integers(seeds);
    make_floats(seeds);
    make_compressed(seeds);
    make_heads(seeds);
    seeds.add("plain_samples", "mosaic",
              std::string(R"({"width": 24, "height": 22, "pattern": "RGGB", "black": 64, "white": 1023, "bits": 16})") +
                  '\0' + std::string(24 * 22 * 2, '\1'));
    FileNoise file_noise{ { { 1e-4, 1e-4, 1e-4 }, { 1e-7, 1e-7, 1e-7 } }, "xxh128:00112233445566778899aabbccddeeff" };
    seeds.add("decoder_answer", "noise", bytes_of_noise(file_noise));
    seeds.add("decoder_answer", "edit", literal("\3\0\0\0\xff\xff\xff\x7f"));
}
