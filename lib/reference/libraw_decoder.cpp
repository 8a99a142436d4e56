// SPDX-License-Identifier: Apache-2.0
#include "reference/libraw_decoder.h"

#include <cmath>
#include <numeric>

#include "reference/libraw_facts.h"
#include "reference/raw_stream.h"

namespace srisp {

namespace {

// 500 Mpx of 16 bits; the largest sensors have 150. Tiny files that claim more must not take our memory.
constexpr unsigned kMostMemoryMb = 1024;
// No decoder makes 128 pixels of a byte: then it gave up in silence and left memory as it was.
constexpr std::size_t kMostPixelsPerByte = 128;

/// Why LibRaw's data are no mosaic of R, G and B as the sensor saw them, or "".
std::string refusal(LibRaw& raw)
{
    const libraw_iparams_t& id = raw.imgdata.idata;
    if (id.is_foveon)
        return "Foveon sensor (three layers, no mosaic): not supported";
    if (raw.is_sraw() || raw.is_coolscan_nef() || raw.imgdata.color.as_shot_wb_applied)
        return "reduced RAW (sRAW, scans, multi-shot) holds processed values, not those of the sensor: not supported";
    if (id.colors == 1)
        return "monochrome sensor: a reference needs three colours";
    if (id.colors != 3)
        return "sensor with " + std::to_string(id.colors) + " filter colours (" + std::string(id.cdesc) +
               "): only R, G, B are supported";
    if (raw.is_fuji_rotated())
        return "Fujifilm SuperCCD (diagonal mosaic): not supported";
    if (raw.imgdata.rawdata.ph1_cblack || raw.imgdata.rawdata.ph1_rblack || raw.imgdata.color.phase_one_data.format)
        return "Phase One IIQ needs corrections that are not supported; convert it to DNG";
    if (id.filters < 1000 && id.filters != LIBRAW_XTRANS)
        return "not a mosaic of R, G and B filters: not supported";
    return {};
}

/// The filters' colours; those of X-Trans repeat after 6, Bayer's after 2. Others (none is known with R, G, B) give "".
CfaPattern cfa_pattern(LibRaw& raw)
{
    CfaPattern cfa;
    cfa.rows = cfa.columns = raw.imgdata.idata.filters == LIBRAW_XTRANS ? 6 : 2;
    for (int row = 0; row < cfa.rows; ++row)
        for (int column = 0; column < cfa.columns; ++column)
            cfa.letters += raw.imgdata.idata.cdesc[raw.COLOR(row, column) & 3];
    for (int row = 0; row < 8 && cfa.rows == 2; ++row) // LibRaw's own period is 8 rows
        for (int column = 0; column < 2; ++column)
            if (raw.imgdata.idata.cdesc[raw.COLOR(row, column) & 3] != cfa.letters[std::size_t(row % 2 * 2 + column)])
                return {};
    return cfa;
}

/// Common black + black per colour + black per position, as LibRaw adds them up.
BlackLevels black_levels(LibRaw& raw, const CfaPattern& cfa)
{
    const libraw_colordata_t& color = raw.imgdata.color;
    const int rows = int(color.cblack[4]), columns = int(color.cblack[5]);
    const bool by_place = rows > 0 && columns > 0 && rows <= 64 && columns <= 64;
    BlackLevels black;
    black.rows = by_place ? std::lcm(rows, cfa.rows) : cfa.rows;
    black.columns = by_place ? std::lcm(columns, cfa.columns) : cfa.columns;
    for (int y = 0; y < black.rows; ++y)
        for (int x = 0; x < black.columns; ++x) {
            double level = double(color.black) + color.cblack[raw.COLOR(y, x) & 3];
            if (by_place)
                level += color.cblack[6 + y % rows * columns + x % columns];
            black.pattern.push_back(float(level));
        }
    return black;
}

/// Opens and unpacks; why it can't, or "".
std::string unpack(LibRaw& raw, RawStream& stream, const FileBytes& file)
{
    // LibRaw would write its complaints to stderr.
    raw.set_dataerror_handler([](void*, const char*, int) {}, nullptr);
    raw.set_memerror_handler([](void*, const char*, const char*) {}, nullptr);
    raw.imgdata.params.max_raw_memory_mb = kMostMemoryMb;
    raw.imgdata.params.raw_processing_options |= LIBRAW_PROCESSING_SRAW_NO_RGB | LIBRAW_PROCESSING_SRAW_NO_INTERPOLATE;
    if (const int code = raw.open_datastream(&stream); code != LIBRAW_SUCCESS)
        return code == LIBRAW_FILE_UNSUPPORTED || code == LIBRAW_DATA_ERROR || code == LIBRAW_IO_ERROR
                   ? "is not a RAW file that LibRaw " + std::string(LibRaw::version()) +
                         " knows, or damaged or truncated"
                   : std::string("LibRaw can't open it: ") + LibRaw::strerror(code);
    if (const std::string why = refusal(raw); !why.empty() && raw.imgdata.idata.dng_version == 0)
        return why;
    stream.end_is_error();
    const int code = raw.unpack();
    if (code == LIBRAW_IO_ERROR || (code != LIBRAW_SUCCESS && stream.eof()))
        return "truncated: image data end before the image is complete (file of " + std::to_string(file.size) +
               " bytes)";
    if (code != LIBRAW_SUCCESS)
        return std::string("LibRaw can't decode it: ") + LibRaw::strerror(code);
    if (raw.error_count() > 0)
        return "damaged image data (LibRaw met " + std::to_string(raw.error_count()) + " decoding errors)";
    const std::size_t pixels = std::size_t(raw.imgdata.sizes.raw_width) * raw.imgdata.sizes.raw_height;
    if (stream.consumed() < pixels / kMostPixelsPerByte)
        return "damaged image data (LibRaw read " + std::to_string(stream.consumed()) + " bytes for " +
               std::to_string(pixels) + " pixels)";
    return {};
}

/// Points `pixels` at the active area of the unpacked samples; an error text if it does not lie within them.
std::string locate_samples(const LibRaw& raw, int left, int top, RawPixels& pixels)
{
    const libraw_rawdata_t& data = raw.imgdata.rawdata;
    const libraw_image_sizes_t& sizes = raw.imgdata.sizes;
    if (pixels.channels == 1 && data.raw_image) {
        pixels.shorts = data.raw_image;
        pixels.pixel_stride = 1;
        pixels.row_stride = std::ptrdiff_t(sizes.raw_pitch / 2);
    } else if (pixels.channels == 3 && data.color4_image) {
        pixels.shorts = data.color4_image[0];
        pixels.pixel_stride = 4;
        pixels.row_stride = std::ptrdiff_t(sizes.raw_pitch / 2);
    } else {
        return "LibRaw decoded it to a form that is not supported";
    }
    if (left < 0 || top < 0 || pixels.width < 2 || pixels.height < 2 || left + pixels.width > sizes.raw_width ||
        top + pixels.height > sizes.raw_height ||
        pixels.row_stride < std::ptrdiff_t(sizes.raw_width) * pixels.pixel_stride)
        return "active area of " + std::to_string(pixels.width) + " x " + std::to_string(pixels.height) +
               " pixels does not lie within the image of " + std::to_string(sizes.raw_width) + " x " +
               std::to_string(sizes.raw_height);
    pixels.shorts += top * pixels.row_stride + std::ptrdiff_t(left) * pixels.pixel_stride;
    return {};
}

std::string describe_pixels(LibRaw& raw, RawImage& image)
{
    RawPixels& pixels = image.pixels;
    pixels.width = raw.imgdata.sizes.width;
    pixels.height = raw.imgdata.sizes.height;
    pixels.cfa = cfa_pattern(raw);
    if (pixels.cfa.rows == 0)
        return "filters in a pattern that is not supported";
    if (const std::string why = check_filters(pixels); !why.empty())
        return why;
    pixels.black = black_levels(raw, pixels.cfa);
    pixels.white.fill(float(raw.imgdata.color.maximum));
    if (const std::string why = check_levels(pixels); !why.empty())
        return why;
    describe_levels(pixels, image.facts);
    describe_camera(raw.imgdata, image.facts, image.notes);
    return locate_samples(raw, raw.imgdata.sizes.left_margin, raw.imgdata.sizes.top_margin, pixels);
}

std::string adopt_dng(const LibRaw& raw, const DngDescription& dng, RawImage& image)
{
    const libraw_image_sizes_t& sizes = raw.imgdata.sizes;
    if (sizes.raw_width != dng.stored_width || sizes.raw_height != dng.stored_height)
        return "LibRaw decoded " + std::to_string(sizes.raw_width) + " x " + std::to_string(sizes.raw_height) +
               " pixels where the DNG says " + std::to_string(dng.stored_width) + " x " +
               std::to_string(dng.stored_height);
    image.pixels = dng.layout;
    image.facts = dng.facts;
    image.notes = dng.notes;
    return locate_samples(raw, dng.left, dng.top, image.pixels);
}

} // namespace

Expected<RawImage> decode_with_libraw(const FileBytes& file, const DngDescription* dng)
{
    struct Decoder { // the order matters: LibRaw may use the stream until it ends
        explicit Decoder(const FileBytes& f) : stream(f.data.get(), f.size) {}
        RawStream stream;
        LibRaw raw{ LIBRAW_OPIONS_NO_MEMERR_CALLBACK | LIBRAW_OPIONS_NO_DATAERR_CALLBACK };
    };
    const auto decoder = std::make_shared<Decoder>(file);
    if (const std::string why = unpack(decoder->raw, decoder->stream, file); !why.empty())
        return Error{ why };
    RawImage image;
    const std::string why = dng ? adopt_dng(decoder->raw, *dng, image) : describe_pixels(decoder->raw, image);
    if (!why.empty())
        return Error{ why };
    image.pixels.owner = decoder;
    return image;
}

} // namespace srisp
