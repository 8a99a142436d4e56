// SPDX-License-Identifier: Apache-2.0
#include "gain_map/gain_map_image.h"

#include <cstdint>
#include <string>

#include "jpeg/jpeg_decompressor.h"

#include <jerror.h>

namespace srisp {

namespace {

constexpr std::int64_t kMostPixels = std::int64_t(64) << 20;

/// Warnings tell of lost data, but for a few that tell of odd writers.
void judge_warning(JpegDecompressor& decoder, int code)
{
    if (code != JWRN_EXTRANEOUS_DATA && code != JWRN_JFIF_MAJOR)
        decoder.fail();
}

/// False: `decoder.message` says why.
bool read_header(JpegDecompressor& decoder, std::string_view bytes)
{
    if (setjmp(decoder.failed))
        return false;
    jpeg_create_decompress(&decoder.info);
    jpeg_mem_src(&decoder.info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_read_header(&decoder.info, TRUE);
    return true;
}

bool read_pixels(JpegDecompressor& decoder, int channels, unsigned char* values)
{
    if (setjmp(decoder.failed))
        return false;
    jpeg_decompress_struct& jpeg = decoder.info;
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
    JpegDecompressor decoder(judge_warning);
    const auto damaged = [&] {
        return Error{ std::string("its gain map is damaged or truncated: ") + decoder.message };
    };
    if (!read_header(decoder, bytes))
        return damaged();
    const jpeg_decompress_struct& jpeg = decoder.info;
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
