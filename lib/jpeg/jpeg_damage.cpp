// SPDX-License-Identifier: Apache-2.0
#include "jpeg/jpeg_damage.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include "jpeg/jpeg_decompressor.h"

#include <jerror.h>

namespace srisp {

namespace {

bool costs_pixels(int message)
{
    switch (message) {
    case JWRN_HIT_MARKER:
    case JWRN_HUFF_BAD_CODE:
    case JWRN_MUST_RESYNC:
    case JWRN_NOT_SEQUENTIAL:
    case JWRN_TOO_MUCH_DATA:
        return true;
    default:
        return false;
    }
}

/// Decodes, and remembers what went wrong.
struct DamageFinder : JpegDecompressor {
    DamageFinder() : JpegDecompressor(note_warning) {}

    /// The first message stays, unless a later one costs pixels.
    static void note_warning(JpegDecompressor& decompressor, int code)
    {
        auto& finder = static_cast<DamageFinder&>(decompressor);
        const bool costs = costs_pixels(code);
        if (finder.message[0] == '\0' || (costs && !finder.pixels_missing))
            finder.keep_message();
        finder.pixels_missing |= costs;
    }

    bool pixels_missing = false;
    bool incomplete = false; ///< scans are missing
    std::vector<JSAMPLE> row;
};

/// Whether all bits of all coefficients have come; a progressive file brings them scan by scan.
bool has_all_scans(const jpeg_decompress_struct& jpeg)
{
    if (!jpeg.progressive_mode || !jpeg.coef_bits)
        return true;
    for (int component = 0; component < jpeg.num_components; ++component)
        if (std::any_of(jpeg.coef_bits[component], jpeg.coef_bits[component] + DCTSIZE2,
                        [](int missing_bits) { return missing_bits != 0; }))
            return false;
    return true;
}

/// False: libjpeg gave up.
bool decode(DamageFinder& finder, std::FILE* file)
{
    jpeg_decompress_struct& jpeg = finder.info;
    if (setjmp(finder.failed) != 0)
        return false;
    jpeg_create_decompress(&jpeg);
    jpeg_stdio_src(&jpeg, file);
    jpeg_read_header(&jpeg, TRUE);
    jpeg.out_color_space = jpeg.jpeg_color_space; // as stored
    jpeg.buffered_image = jpeg_has_multiple_scans(&jpeg);
    jpeg_start_decompress(&jpeg);
    if (jpeg.buffered_image) {
        while (!jpeg_input_complete(&jpeg))
            if (jpeg_consume_input(&jpeg) == JPEG_SUSPENDED)
                break;
        finder.incomplete = !has_all_scans(jpeg);
        return true;
    }
    finder.row.resize(std::size_t(jpeg.output_width) * static_cast<std::size_t>(jpeg.output_components));
    JSAMPROW rows[1] = { finder.row.data() };
    while (jpeg.output_scanline < jpeg.output_height)
        jpeg_read_scanlines(&jpeg, rows, 1);
    return true;
}

} // namespace

JpegDamage find_jpeg_damage(const std::string& path)
{
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
    if (!file)
        return { true, "cannot be read" };
    DamageFinder finder;
    if (!decode(finder, file.get()))
        return { true, finder.message };
    if (finder.incomplete && !finder.pixels_missing)
        return { true, "breaks off before its last scan" };
    return { finder.pixels_missing, finder.message };
}

} // namespace srisp
