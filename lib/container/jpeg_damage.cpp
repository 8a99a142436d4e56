// SPDX-License-Identifier: Apache-2.0
#include "container/jpeg_damage.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <memory>
#include <vector>

#include <jerror.h>
#include <jpeglib.h>

namespace srisp {

namespace {

/// libjpeg's error handler, as a C structure that begins with libjpeg's own.
struct Handler {
    jpeg_error_mgr base;
    std::jmp_buf failed;
    bool pixels_missing;
    char text[JMSG_LENGTH_MAX];
};

Handler* handler_of(j_common_ptr jpeg)
{
    return reinterpret_cast<Handler*>(jpeg->err);
}

/// The first message stays, unless a later one costs pixels.
void keep_message(j_common_ptr jpeg, bool costs_pixels)
{
    Handler* const handler = handler_of(jpeg);
    if (handler->text[0] == '\0' || (costs_pixels && !handler->pixels_missing))
        jpeg->err->format_message(jpeg, handler->text);
    handler->pixels_missing |= costs_pixels;
}

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

void on_message(j_common_ptr jpeg, int level)
{
    if (level < 0)
        keep_message(jpeg, costs_pixels(jpeg->err->msg_code));
}

[[noreturn]] void on_error(j_common_ptr jpeg)
{
    keep_message(jpeg, true);
    std::longjmp(handler_of(jpeg)->failed, 1);
}

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

/// What outlives a jump out of libjpeg.
struct Decoding {
    jpeg_decompress_struct jpeg;
    Handler handler;
    std::vector<JSAMPLE> row;
    bool incomplete;
};

/// False: libjpeg gave up.
bool decode(Decoding& decoding, std::FILE* file)
{
    jpeg_decompress_struct& jpeg = decoding.jpeg;
    if (setjmp(decoding.handler.failed) != 0)
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
        decoding.incomplete = !has_all_scans(jpeg);
        return true;
    }
    decoding.row.resize(std::size_t(jpeg.output_width) * static_cast<std::size_t>(jpeg.output_components));
    JSAMPROW rows[1] = { decoding.row.data() };
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
    Decoding decoding{};
    decoding.jpeg.err = jpeg_std_error(&decoding.handler.base);
    decoding.handler.base.emit_message = on_message;
    decoding.handler.base.error_exit = on_error;
    const bool whole = decode(decoding, file.get());
    jpeg_destroy_decompress(&decoding.jpeg);
    if (whole && decoding.incomplete && !decoding.handler.pixels_missing)
        return { true, "breaks off before its last scan" };
    return { decoding.handler.pixels_missing, decoding.handler.text };
}

} // namespace srisp
