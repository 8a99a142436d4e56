// SPDX-License-Identifier: Apache-2.0
#include "reference/decoders.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "container/image_memory.h"
#include "raw_file/libraw_traps.h"
#include "reference/raw_stream.h"
#include "reference/tiff_raw.h"

namespace srisp {

namespace {

// 500 Mpx of 16 bits; the largest sensors have 150. Tiny files that claim more must not take our memory.
constexpr unsigned kMostMemoryMb = 1024;
// No decoder makes 128 pixels of a byte: then it gave up in silence and left memory as it was.
constexpr std::size_t kMostPixelsPerByte = 128;

/// Whether LibRaw's data are a mosaic of R, G and B as the sensor saw them.
Status check_sensor(LibRaw& raw)
{
    const libraw_iparams_t& id = raw.imgdata.idata;
    if (id.is_foveon)
        return Error{ "Foveon sensor (three layers, no mosaic): not supported" };
    if (raw.is_sraw() || raw.is_coolscan_nef() || raw.imgdata.color.as_shot_wb_applied)
        return Error{
            "reduced RAW (sRAW, scans, multi-shot) holds processed values, not those of the sensor: not supported"
        };
    if (id.colors == 1)
        return Error{ "monochrome sensor: a reference needs three colours" };
    if (id.colors != 3)
        return Error{ "sensor with " + std::to_string(id.colors) + " filter colours (" + std::string(id.cdesc) +
                      "): only R, G, B are supported" };
    if (raw.is_fuji_rotated())
        return Error{ "Fujifilm SuperCCD (diagonal mosaic): not supported" };
    if (raw.imgdata.rawdata.ph1_cblack || raw.imgdata.rawdata.ph1_rblack || raw.imgdata.color.phase_one_data.format)
        return Error{ "Phase One IIQ needs corrections that are not supported; convert it to DNG" };
    if (id.filters < 1000 && id.filters != LIBRAW_XTRANS)
        return Error{ "not a mosaic of R, G and B filters: not supported" };
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

/// Why LibRaw did not open it, as far as it says.
std::string unopened(int code, const FileBytes& file, const DngDescription* dng)
{
    if (code != LIBRAW_FILE_UNSUPPORTED && code != LIBRAW_DATA_ERROR && code != LIBRAW_IO_ERROR)
        return std::string("LibRaw can't open it: ") + LibRaw::strerror(code);
    const std::string libraw = "LibRaw " + std::string(LibRaw::version());
    if (const std::string name = dng ? "" : tiff_raw_name(file); !name.empty())
        return "is " + name + " that " + libraw +
               " does not decode, or damaged or truncated; if other programs read it, convert it to DNG";
    return "is not a RAW file that " + libraw + " knows, or damaged or truncated";
}

/// Opens and unpacks.
Status unpack(LibRaw& raw, RawStream& stream, const FileBytes& file, const DngDescription* dng)
{
    // LibRaw would write its complaints to stderr.
    raw.set_dataerror_handler([](void*, const char*, int) {}, nullptr);
    raw.set_memerror_handler([](void*, const char*, const char*) {}, nullptr);
    raw.imgdata.params.max_raw_memory_mb = kMostMemoryMb;
    raw.imgdata.params.raw_processing_options |= LIBRAW_PROCESSING_SRAW_NO_RGB | LIBRAW_PROCESSING_SRAW_NO_INTERPOLATE;
    if (const int code = raw.open_datastream(&stream); code != LIBRAW_SUCCESS)
        return Error{ unopened(code, file, dng) };
    if (Status status = check_sensor(raw); !status && raw.imgdata.idata.dng_version == 0)
        return status;
    const std::size_t pixels = std::size_t(raw.imgdata.sizes.raw_width) * raw.imgdata.sizes.raw_height;
    if (Status fits = check_memory(pixels, 1); !fits)
        return fits;
    stream.end_is_error();
    const int code = raw.unpack();
    if (code == LIBRAW_IO_ERROR || (code != LIBRAW_SUCCESS && stream.eof()))
        return Error{ "truncated: image data end before the image is complete (file of " + std::to_string(file.size) +
                      " bytes)" };
    if (code != LIBRAW_SUCCESS)
        return Error{ std::string("LibRaw can't decode it: ") + LibRaw::strerror(code) };
    if (raw.error_count() > 0)
        return Error{ "damaged image data (LibRaw met " + std::to_string(raw.error_count()) + " decoding errors)" };
    if (stream.consumed() < pixels / kMostPixelsPerByte)
        return Error{ "damaged image data (LibRaw read " + std::to_string(stream.consumed()) + " bytes for " +
                      std::to_string(pixels) + " pixels)" };
    return {};
}

/// Points `pixels` at the active area of the unpacked samples, which must lie within them.
Status locate_samples(const LibRaw& raw, int left, int top, RawPixels& pixels)
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
        return Error{ "LibRaw decoded it to a form that is not supported" };
    }
    if (left < 0 || top < 0 || pixels.width < 2 || pixels.height < 2 || left + pixels.width > sizes.raw_width ||
        top + pixels.height > sizes.raw_height ||
        pixels.row_stride < std::ptrdiff_t(sizes.raw_width) * pixels.pixel_stride)
        return Error{ "active area of " + std::to_string(pixels.width) + " x " + std::to_string(pixels.height) +
                      " pixels does not lie within the image of " + std::to_string(sizes.raw_width) + " x " +
                      std::to_string(sizes.raw_height) };
    pixels.shorts += top * pixels.row_stride + std::ptrdiff_t(left) * pixels.pixel_stride;
    return {};
}

/// EXIF orientation of dcraw's flip: 1 mirrors left-right, 2 top-bottom, 4 swaps the axes first.
int orientation_of_flip(int flip)
{
    static const int kOrientations[] = { 1, 2, 4, 3, 5, 8, 6, 7 };
    return flip >= 0 && flip < 8 ? kOrientations[flip] : 1;
}

float known(float value)
{
    return std::isfinite(value) && value > 0 ? value : 0;
}

/// Fills the facts of camera and exposure from what LibRaw read; what was assumed goes to `notes`.
void describe_camera(const libraw_data_t& data, CameraFacts& facts, std::vector<std::string>& notes)
{
    facts.make = data.idata.make;
    facts.model = data.idata.model;
    facts.orientation = orientation_of_flip(data.sizes.flip);

    const auto& matrix = data.color.cam_xyz; // LibRaw's table of Adobe's D65 matrices
    if (matrix[0][0] != 0) {
        CameraFacts::ColorMatrix entry;
        for (std::size_t i = 0; i < 9; ++i)
            entry.xyz_to_camera[i] = matrix[i / 3][i % 3];
        entry.illuminant = 21; // D65
        facts.color_matrices.push_back(entry);
        notes.push_back("colour matrix from LibRaw's table for this camera (D65), not from the file");
    }
    const auto& multipliers = data.color.cam_mul;
    if (known(multipliers[0]) > 0 && known(multipliers[1]) > 0 && known(multipliers[2]) > 0)
        facts.as_shot_neutral = { multipliers[1] / multipliers[0], 1, multipliers[1] / multipliers[2] };
    facts.iso = known(data.other.iso_speed);
    facts.exposure_time_s = known(data.other.shutter);
    facts.f_number = known(data.other.aperture);
}

Status describe_pixels(LibRaw& raw, RawImage& image)
{
    RawPixels& pixels = image.pixels;
    pixels.width = raw.imgdata.sizes.width;
    pixels.height = raw.imgdata.sizes.height;
    pixels.cfa = cfa_pattern(raw);
    if (pixels.cfa.rows == 0)
        return Error{ "filters in a pattern that is not supported" };
    if (Status status = check_filters(pixels); !status)
        return status;
    pixels.black = black_levels(raw, pixels.cfa);
    pixels.white.fill(float(raw.imgdata.color.maximum));
    if (Status status = check_levels(pixels); !status)
        return status;
    describe_levels(pixels, image.facts);
    describe_camera(raw.imgdata, image.facts, image.notes);
    return locate_samples(raw, raw.imgdata.sizes.left_margin, raw.imgdata.sizes.top_margin, pixels);
}

Status adopt_dng(const LibRaw& raw, const DngDescription& dng, RawImage& image)
{
    const libraw_image_sizes_t& sizes = raw.imgdata.sizes;
    if (sizes.raw_width != dng.stored_width || sizes.raw_height != dng.stored_height)
        return Error{ "LibRaw decoded " + std::to_string(sizes.raw_width) + " x " + std::to_string(sizes.raw_height) +
                      " pixels where the DNG says " + std::to_string(dng.stored_width) + " x " +
                      std::to_string(dng.stored_height) };
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
    if (Status status = check_libraw_traps(file); !status)
        return status.error();
    if (Status status = dng ? Status() : check_tiff_raw(file); !status)
        return status.error();
    const auto decoder = std::make_shared<Decoder>(file);
    if (Status status = unpack(decoder->raw, decoder->stream, file, dng); !status)
        return status.error();
    RawImage image;
    if (Status status = dng ? adopt_dng(decoder->raw, *dng, image) : describe_pixels(decoder->raw, image); !status)
        return status.error();
    image.pixels.owner = decoder;
    return image;
}

} // namespace srisp
