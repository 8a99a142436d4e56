// SPDX-License-Identifier: Apache-2.0
#include "jpeg/jpeg_data.h"

#include "jpeg/jpeg_decompressor.h"

#include <jerror.h>

namespace srisp {

namespace {

/// Most warnings say that pixels are made up. Bytes between markers and a missing end marker harm none.
void judge_warning(JpegDecompressor& decompressor, int code)
{
    if (code != JWRN_EXTRANEOUS_DATA && code != JWRN_JPEG_EOF)
        decompressor.fail();
}

/// False: `message` says why.
bool decode(JpegDecompressor& decompressor, const unsigned char* data, std::size_t size, const JpegHeader& header,
            unsigned char* target)
{
    jpeg_decompress_struct& info = decompressor.info;
    if (setjmp(decompressor.failed))
        return false;
    jpeg_create_decompress(&info);
    jpeg_mem_src(&info, data, static_cast<unsigned long>(size));
    jpeg_read_header(&info, TRUE);
    info.out_color_space = header.components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    info.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&info);
    if (int(info.output_width) != header.width || int(info.output_height) != header.height ||
        info.output_components != header.components)
        ERREXIT(&info, JERR_IMAGE_TOO_BIG);
    const std::size_t row_bytes = std::size_t(header.width) * std::size_t(header.components);
    while (info.output_scanline < info.output_height) {
        JSAMPROW row = target + info.output_scanline * row_bytes;
        jpeg_read_scanlines(&info, &row, 1);
    }
    return true;
}

} // namespace

std::optional<JpegHeader> jpeg_header(const unsigned char* data, std::size_t size)
{
    if (size < 4 || data[0] != 0xff || data[1] != 0xd8)
        return {};
    std::size_t at = 2;
    while (at + 4 <= size && data[at] == 0xff) {
        const int marker = data[at + 1];
        if (marker == 0xff) { // fill byte
            ++at;
            continue;
        }
        const std::size_t length = std::size_t(data[at + 2]) << 8 | data[at + 3];
        const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (frame && length >= 8 && at + 10 <= size)
            return JpegHeader{ marker - 0xc0, data[at + 4], data[at + 7] << 8 | data[at + 8],
                               data[at + 5] << 8 | data[at + 6], data[at + 9] };
        if (frame || length < 2)
            return {};
        at += 2 + length;
    }
    return {};
}

Expected<std::vector<unsigned char>> decode_jpeg(const unsigned char* data, std::size_t size, const JpegHeader& header)
{
    std::vector<unsigned char> pixels(std::size_t(header.width) * std::size_t(header.height) *
                                      std::size_t(header.components));
    JpegDecompressor decompressor(judge_warning);
    if (!decode(decompressor, data, size, header, pixels.data()))
        return Error{ decompressor.message };
    return pixels;
}

} // namespace srisp
