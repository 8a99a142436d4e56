// SPDX-License-Identifier: Apache-2.0
#include "dng/dng_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "raw_file/tiff_numbers.h"

namespace srisp {

namespace {

constexpr int kSmallestSide = 2;
constexpr float kLargestHalf = 65504;

std::string sides(int width, int height)
{
    return std::to_string(width) + " x " + std::to_string(height);
}

Status check_geometry(const DngImage& image)
{
    if (Status status = check_dng_size(image.width, image.height); !status)
        return status;
    if (image.planes != 1 && image.planes != 3)
        return Error{ "image of " + std::to_string(image.planes) +
                      " channels: 1 (a mosaic) or 3 (R, G, B) are possible" };
    if ((image.shorts == nullptr) == (image.floats == nullptr))
        return Error{ "either integers or floats are needed" };
    static const char* const kPhases[] = { "RGGB", "GRBG", "GBRG", "BGGR" };
    const bool phase = std::find(std::begin(kPhases), std::end(kPhases), image.cfa_pattern) != std::end(kPhases);
    if (image.planes == 1 && !phase)
        return Error{ "mosaic with the filters '" + image.cfa_pattern + "': RGGB, GRBG, GBRG and BGGR are possible" };
    return {};
}

Status check_storage(const DngImage& image, const DngOptions& options)
{
    if (image.floats && image.planes == 1)
        return Error{ "mosaic of floats: few programs read that; integers or three channels are possible" };
    const std::string bits = std::to_string(options.bits) + " bits";
    if (image.floats && options.bits != 16 && options.bits != 32)
        return Error{ "floats of " + bits + ": 16 and 32 are possible" };
    if (image.shorts && (options.bits < 10 || options.bits > 16))
        return Error{ "integers of " + bits + ": 10 to 16 are possible" };
    if (image.floats && options.compression == DngCompression::lossless)
        return Error{ "compression 'lossless' is for integers: floats can have 'none' or 'deflate'" };
    if (image.shorts && options.compression == DngCompression::deflate)
        return Error{ "compression 'deflate' is for floats: integers can have 'none' or 'lossless'" };
    if (image.floats && options.layout == DngLayout::cinema)
        return Error{ "layout 'cinema' is for integers, not for floats" };
    return {};
}

Status check_levels(const DngImage& image, const DngOptions& options)
{
    const std::size_t planes = std::size_t(image.planes);
    if (std::min(image.black_rows, image.black_columns) < 1 ||
        std::max(image.black_rows, image.black_columns) > kLargestBlackPattern)
        return Error{ "black levels in a pattern of " + sides(image.black_rows, image.black_columns) + ": 1 to " +
                      std::to_string(kLargestBlackPattern) + " are possible" };
    const std::size_t needed = std::size_t(image.black_rows) * std::size_t(image.black_columns) * planes;
    if (!image.black.empty() && image.black.size() != needed)
        return Error{ std::to_string(image.black.size()) + " black levels where their pattern needs " +
                      std::to_string(needed) };
    const std::uint32_t largest =
        image.shorts ? (1u << options.bits) - 1 : std::uint32_t(std::numeric_limits<std::int32_t>::max());
    for (std::size_t plane = 0; plane < planes; ++plane)
        if (white_level(image, options, plane) > largest)
            return Error{ "white level " + std::to_string(image.white[plane]) + ": " + std::to_string(largest) +
                          " is the limit" };
    for (std::size_t i = 0; i < image.black.size(); ++i) {
        const std::uint32_t white = white_level(image, options, i % planes);
        if (!(image.black[i] >= 0 && image.black[i] < float(white)))
            return Error{ "black level " + std::to_string(image.black[i]) +
                          ": it must lie from 0 to below the white "
                          "level, " +
                          std::to_string(white) };
    }
    if (!std::isfinite(image.baseline_exposure) || std::abs(image.baseline_exposure) > 100)
        return Error{ "baseline exposure " + std::to_string(image.baseline_exposure) + ": -100 to 100 are possible" };
    return {};
}

/// Readers without knowledge of DNG take the largest image for the RAW one.
Status check_preview(const DngImage& image)
{
    if (image.preview && (std::min(image.preview_width, image.preview_height) < 1 ||
                          image.preview_width > image.width || image.preview_height > image.height))
        return Error{ "preview of " + sides(image.preview_width, image.preview_height) +
                      " pixels: 1 x 1 to the image's " + sides(image.width, image.height) + " are possible" };
    return {};
}

std::string place(const DngImage& image, std::ptrdiff_t sample, int row)
{
    return " at pixel (" + std::to_string(sample / image.planes) + ", " + std::to_string(row) + ")";
}

Status check_row(const DngImage& image, const DngOptions& options, int y)
{
    const std::ptrdiff_t count = std::ptrdiff_t(image.width) * image.planes;
    if (image.shorts) {
        const std::uint16_t* row = image.shorts + y * image.row_stride;
        const std::uint16_t* largest = std::max_element(row, row + count);
        if (*largest >> options.bits == 0)
            return {};
        return Error{ "sample of " + std::to_string(*largest) + place(image, largest - row, y) +
                      ": it does not fit into " + std::to_string(options.bits) + " bits" };
    }
    const float* row = image.floats + y * image.row_stride;
    const float limit = options.bits == 16 ? kLargestHalf : std::numeric_limits<float>::max();
    const float* bad = std::find_if(row, row + count, [&](float v) { return !(std::abs(v) <= limit); });
    if (bad == row + count)
        return {};
    return Error{ (std::isfinite(*bad) ? "sample of " + std::to_string(*bad) : std::string("NaN or infinity")) +
                  place(image, bad - row, y) +
                  (std::isfinite(*bad) ? ": 65504 is the limit of floats of 16 bits" : "") };
}

} // namespace

Status check_dng_size(int width, int height)
{
    if (std::min(width, height) >= kSmallestSide && std::max(width, height) <= kLargestDngSide)
        return {};
    return Error{ "image of " + sides(width, height) + " pixels: from " + std::to_string(kSmallestSide) + " to " +
                  std::to_string(kLargestDngSide) + " a side are possible" };
}

std::uint32_t white_level(const DngImage& image, const DngOptions& options, std::size_t plane)
{
    if (image.white[plane] != 0)
        return image.white[plane];
    return image.floats ? 1 : (1u << options.bits) - 1;
}

Status check_dng_image(const DngImage& image, const DngOptions& options)
{
    if (Status status = check_geometry(image); !status)
        return status;
    if (Status status = check_storage(image, options); !status)
        return status;
    if (Status status = check_levels(image, options); !status)
        return status;
    return check_preview(image);
}

Status check_dng_samples(const DngImage& image, const DngOptions& options)
{
    if (image.shorts && options.bits == 16)
        return {};
    std::vector<Status> rows(std::size_t(image.height));
    parallel_tasks(image.height, options.threads,
                   [&](std::int64_t y) { rows[std::size_t(y)] = check_row(image, options, int(y)); });
    const auto bad = std::find_if(rows.begin(), rows.end(), [](const Status& row) { return !row; });
    return bad == rows.end() ? Status() : *bad;
}

} // namespace srisp
