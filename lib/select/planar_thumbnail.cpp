// SPDX-License-Identifier: Apache-2.0
#include "select/planar_thumbnail.h"

#include <limits>

#include "features/lanes.h"
#include "thumbnail/area_squasher.h"

namespace srisp {

constexpr int kRow = 3 * kThumbnailSize; ///< floats of a thumbnail's row

/// Sums of the columns of some rows.
SRISP_WIDE_LANES static void add_up_rows(const float* rows, int count, float* sums)
{
    for (int i = 0; i < kRow; ++i)
        sums[i] = rows[i];
    for (int y = 1; y < count; ++y)
        for (int i = 0; i < kRow; ++i)
            sums[i] += rows[y * kRow + i];
}

/// Means of squares of whole pixels: where `size` divides the thumbnail's.
static void average_squares(const Thumbnail& thumbnail, int size, Planes out)
{
    const int side = kThumbnailSize / size;
    const float share = 1.0f / static_cast<float>(side * side);
    float sums[kRow];
    for (int y = 0; y < size; ++y) {
        add_up_rows(thumbnail.rgb.data() + y * side * kRow, side, sums);
        for (int x = 0; x < size; ++x)
            for (int c = 0; c < 3; ++c) {
                float sum = 0;
                for (int i = 0; i < side; ++i)
                    sum += sums[3 * (x * side + i) + c];
                out.plane(c)[y * size + x] = sum * share;
            }
    }
}

/// Means of areas whose borders cut pixels.
static void average_areas(const Thumbnail& thumbnail, int size, Planes out)
{
    AreaSquasher squasher(kThumbnailSize, kThumbnailSize, size);
    squasher.add_rows(thumbnail.view());
    constexpr int kUpright = 1;
    split_channels(squasher.finish(kUpright).data(), out, std::size_t(size) * size);
}

PlanarThumbnail::PlanarThumbnail(const Thumbnail& thumbnail, int size) : PlanarThumbnail(size)
{
    if (size == kThumbnailSize)
        split_channels(thumbnail.rgb.data(), planes(), count());
    else if (kThumbnailSize % size == 0)
        average_squares(thumbnail, size, planes());
    else
        average_areas(thumbnail, size, planes());
}

EncoderScale linear_scale(bool perceptual)
{
    return perceptual ? EncoderScale{ 1 / 2.2f, 1e-5f, -0.3f }
                      : EncoderScale{ 1, std::numeric_limits<float>::min(), 0 };
}

void add_to_input(EncoderInput& input, int first_channel, Planes values, float offset)
{
    const int size = input.size(), channels = input.channels();
    for (int y = 0; y < size; ++y) {
        const std::ptrdiff_t begin = std::ptrdiff_t(y) * size;
        const float *const r = values.plane(0) + begin, *const g = values.plane(1) + begin,
                           *const b = values.plane(2) + begin;
        float* to = input.row(y) + first_channel;
        for (int x = 0; x < size; ++x, to += channels) {
            to[0] = r[x] + offset;
            to[1] = g[x] + offset;
            to[2] = b[x] + offset;
        }
    }
}

EncoderInput display_input(const PlanarThumbnail& image, bool perceptual)
{
    EncoderInput input(3, image.size());
    add_to_input(input, 0, image.planes(), perceptual ? -0.4f : 0.0f);
    return input;
}

EncoderInput linear_input(const PlanarThumbnail& image, bool perceptual)
{
    const EncoderScale scale = linear_scale(perceptual);
    PlanarThumbnail scaled(image.size());
    power(image.planes(), scaled.planes(), image.count(), scale.exponent, scale.floor);
    EncoderInput input(3, image.size());
    add_to_input(input, 0, scaled.planes(), scale.offset);
    return input;
}

} // namespace srisp
