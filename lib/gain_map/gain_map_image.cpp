// SPDX-License-Identifier: Apache-2.0
#include "gain_map/gain_map_image.h"

#include <csetjmp>
#include <cstdint>
#include <cstdio> // for jpeglib.h
#include <string>

#include <jpeglib.h>

#include <jerror.h>

namespace srisp {

namespace {

constexpr std::int64_t kMostPixels = std::int64_t(64) << 20;

/// A decoder of libjpeg whose errors end where `failed` was set; closes itself.
struct JpegDecoder {
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    std::jmp_buf failed;
    char message[JMSG_LENGTH_MAX] = "";

    JpegDecoder()
    {
        jpeg.err = jpeg_std_error(&errors);
        jpeg.client_data = this;
        errors.error_exit = fail;
        errors.emit_message = take_message;
        errors.output_message = [](j_common_ptr) {};
    }
    ~JpegDecoder() { jpeg_destroy_decompress(&jpeg); }
    JpegDecoder(const JpegDecoder&) = delete;
    JpegDecoder& operator=(const JpegDecoder&) = delete;

    [[noreturn]] static void fail(j_common_ptr common)
    {
        auto* decoder = static_cast<JpegDecoder*>(common->client_data);
        common->err->format_message(common, decoder->message);
        std::longjmp(decoder->failed, 1);
    }
    /// Warnings (level −1) tell of lost data, but for a few that tell of odd writers.
    static void take_message(j_common_ptr common, int level)
    {
        const int code = common->err->msg_code;
        if (level < 0 && code != JWRN_EXTRANEOUS_DATA && code != JWRN_JFIF_MAJOR)
            fail(common);
    }
};

/// False: `decoder.message` says why. An error jumps out of here: nothing in these functions has a destructor.
bool read_header(JpegDecoder& decoder, std::string_view bytes)
{
    if (setjmp(decoder.failed))
        return false;
    jpeg_create_decompress(&decoder.jpeg);
    jpeg_mem_src(&decoder.jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&decoder.jpeg, TRUE);
    return true;
}

bool read_pixels(JpegDecoder& decoder, int channels, unsigned char* values)
{
    if (setjmp(decoder.failed))
        return false;
    jpeg_decompress_struct& jpeg = decoder.jpeg;
    jpeg.out_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = values + std::size_t(jpeg.output_scanline) * jpeg.output_width * std::size_t(channels);
        jpeg_read_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_decompress(&jpeg);
    return true;
}

} // namespace

Expected<GainMapImage> decode_gain_map_image(std::string_view bytes)
{
    JpegDecoder decoder;
    const auto damaged = [&] {
        return Error{ std::string("its gain map is damaged or truncated: ") + decoder.message };
    };
    if (!read_header(decoder, bytes))
        return damaged();
    const jpeg_decompress_struct& jpeg = decoder.jpeg;
    if (jpeg.num_components != 1 && jpeg.num_components != 3)
        return Error{ "its gain map has " + std::to_string(jpeg.num_components) +
                      " colour channels; 1 or 3 are possible" };
    GainMapImage image{ int(jpeg.image_width), int(jpeg.image_height), jpeg.num_components, {} };
    const std::int64_t pixels = std::int64_t(image.width) * image.height;
    if (pixels > kMostPixels)
        return Error{ "its gain map has " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                      " pixels; the limit is " + std::to_string(kMostPixels) };
    image.values.resize(std::size_t(pixels * image.channels));
    if (!read_pixels(decoder, image.channels, image.values.data()))
        return damaged();
    return image;
}

} // namespace srisp
