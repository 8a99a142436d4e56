// SPDX-License-Identifier: Apache-2.0
#include "dng/dng_tags.h"

#include <algorithm>
#include <cmath>

#include "dng/dng_check.h"
#include "raw_file/tiff_numbers.h"

namespace srisp {

namespace {

using namespace tiff_tag;

constexpr std::uint32_t kUncompressed = 1, kJpeg = 7, kDeflate = 8;
constexpr std::uint32_t kRgb = 2; // in PhotometricInterpretation
constexpr std::uint32_t kFloatPredictor = 3, kFloatSamples = 3;
constexpr std::uint32_t kReduced = 1; // in NewSubFileType
constexpr std::uint32_t kSrgb = 2;    // in PreviewColorSpace
constexpr std::uint32_t kPreviewPlanes = 3;

std::uint32_t compression_code(DngCompression compression)
{
    switch (compression) {
    case DngCompression::lossless:
        return kJpeg;
    case DngCompression::deflate:
        return kDeflate;
    default:
        return kUncompressed;
    }
}

/// Pairs of numbers for all planes at once, or for each of three colours.
bool is_noise_profile(const std::vector<double>& profile)
{
    return (profile.size() == 2 || profile.size() == 6) &&
           std::all_of(profile.begin(), profile.end(), [](double v) { return std::isfinite(v) && v >= 0; });
}

void set_levels(const DngImage& image, const DngOptions& options, TiffFolderBytes& folder)
{
    const std::size_t planes = std::size_t(image.planes);
    folder.set_shorts(kBlackLevelRepeatDim, { std::uint32_t(image.black_rows), std::uint32_t(image.black_columns) });
    const std::size_t count = std::size_t(image.black_rows) * std::size_t(image.black_columns) * planes;
    folder.set_rationals(kBlackLevel, image.black.empty() ? std::vector<float>(count) : image.black);
    std::vector<std::uint32_t> white;
    for (std::size_t plane = 0; plane < planes; ++plane)
        white.push_back(white_level(image, options, plane));
    folder.set_longs(kWhiteLevel, white);
}

void set_filters(const std::string& pattern, TiffFolderBytes& folder)
{
    std::string colors;
    for (const char letter : pattern)
        colors += letter == 'R' ? '\0' : letter == 'G' ? '\1' : '\2';
    folder.set_shorts(kCfaRepeatPatternDim, { 2, 2 });
    folder.set_bytes(kCfaPattern, colors);
    folder.set_bytes(kCfaPlaneColor, std::string("\0\1\2", 3));
    folder.set_shorts(kCfaLayout, { 1 }); // rectangular
}

} // namespace

void set_file_tags(const DngImage& image, TiffFolderBytes& folder, std::vector<std::string>& notes)
{
    folder.set_bytes(kDngVersion, std::string("\1\4\0\0", 4));
    // Floats and their Deflate came with 1.4; all else that must be understood is in 1.1.
    folder.set_bytes(kDngBackwardVersion, image.floats ? std::string("\1\4\0\0", 4) : std::string("\1\1\0\0", 4));
    folder.set_text(kSoftware, "srisp " SRISP_VERSION);
    for (const auto& [tag, text] : { std::pair{ kImageDescription, &image.description },
                                     { kDateTime, &image.date_time },
                                     { kArtist, &image.artist },
                                     { kCopyright, &image.copyright } })
        if (!text->empty())
            folder.set_text(tag, *text);
    if (!image.xmp.empty())
        folder.set_bytes(kXmp, image.xmp);
    folder.set_signed_rationals(kBaselineExposure, { image.baseline_exposure });
    if (is_noise_profile(image.facts.noise_profile))
        folder.set_doubles(kNoiseProfile, image.facts.noise_profile);
    else if (!image.facts.noise_profile.empty())
        notes.push_back("a noise profile of " + std::to_string(image.facts.noise_profile.size()) +
                        " values was left out: 2 or 6, none below 0, are possible");
}

void set_raw_tags(const DngImage& image, const DngOptions& options, const ImageBlocks& blocks, TiffFolderBytes& folder)
{
    const std::uint32_t width = std::uint32_t(image.width), height = std::uint32_t(image.height);
    const std::size_t planes = std::size_t(image.planes);
    folder.set_longs(kNewSubfileType, { 0 });
    folder.set_longs(kImageWidth, { width });
    folder.set_longs(kImageLength, { height });
    folder.set_shorts(kBitsPerSample, std::vector<std::uint32_t>(planes, std::uint32_t(options.bits)));
    folder.set_shorts(kCompression, { compression_code(options.compression) });
    folder.set_shorts(kPhotometric, { std::uint32_t(planes == 1 ? kPhotometricCfa : kPhotometricLinearRaw) });
    folder.set_shorts(kSamplesPerPixel, { std::uint32_t(planes) });
    folder.set_shorts(kPlanarConfiguration, { 1 });
    if (image.floats)
        folder.set_shorts(kSampleFormat, std::vector<std::uint32_t>(planes, kFloatSamples));
    if (options.compression == DngCompression::deflate)
        folder.set_shorts(kPredictor, { kFloatPredictor });
    if (blocks.tiled()) {
        folder.set_longs(kTileWidth, { std::uint32_t(blocks.block_width()) });
        folder.set_longs(kTileLength, { std::uint32_t(blocks.block_height()) });
    } else {
        folder.set_longs(kRowsPerStrip, { std::uint32_t(blocks.block_height()) });
    }
    folder.set_longs(blocks.tiled() ? kTileByteCounts : kStripByteCounts, blocks.sizes());
    set_raw_offsets(blocks, 0, folder);

    if (planes == 1)
        set_filters(image.cfa_pattern, folder);
    set_levels(image, options, folder);
    folder.set_longs(kActiveArea, { 0, 0, height, width });
    folder.set_rationals(kDefaultScale, { 1, 1 });
    folder.set_longs(kDefaultCropOrigin, { 0, 0 });
    folder.set_longs(kDefaultCropSize, { width, height });
}

void set_raw_offsets(const ImageBlocks& blocks, std::uint32_t offset, TiffFolderBytes& folder)
{
    std::vector<std::uint32_t> offsets;
    for (const std::uint32_t size : blocks.sizes()) {
        offsets.push_back(offset);
        offset += std::uint32_t(ImageBlocks::padded(size));
    }
    folder.set_longs(blocks.tiled() ? kTileOffsets : kStripOffsets, offsets);
}

void set_preview_tags(const DngImage& image, std::uint32_t offset, TiffFolderBytes& folder)
{
    folder.set_longs(kNewSubfileType, { kReduced });
    folder.set_longs(kImageWidth, { std::uint32_t(image.preview_width) });
    folder.set_longs(kImageLength, { std::uint32_t(image.preview_height) });
    folder.set_shorts(kBitsPerSample, { 8, 8, 8 });
    folder.set_shorts(kCompression, { kUncompressed });
    folder.set_shorts(kPhotometric, { kRgb });
    folder.set_longs(kStripOffsets, { offset });
    folder.set_shorts(kSamplesPerPixel, { kPreviewPlanes });
    folder.set_longs(kRowsPerStrip, { std::uint32_t(image.preview_height) });
    folder.set_longs(kStripByteCounts, { std::uint32_t(preview_bytes(image)) });
    folder.set_shorts(kPlanarConfiguration, { 1 });
    folder.set_longs(kPreviewColorSpace, { kSrgb });
}

std::size_t preview_bytes(const DngImage& image)
{
    return std::size_t(image.preview_width) * std::size_t(image.preview_height) * kPreviewPlanes;
}

} // namespace srisp
