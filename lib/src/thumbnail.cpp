// SPDX-License-Identifier: Apache-2.0
#include <srisp/thumbnail.h>

#include <algorithm>

#include "area_average.h"

namespace srisp {

namespace {
constexpr int kSize = kThumbnailSize;
}

struct ThumbnailBuilder::State {
    int width, height, next_row = 0;
    AxisCoverage columns, rows;
    std::vector<double> line = std::vector<double>(kSize * 3);         // one input row, squashed
    std::vector<double> sums = std::vector<double>(kSize * kSize * 3); // of shares, over the whole image
};

ThumbnailBuilder::ThumbnailBuilder(int width, int height)
    : m_state(new State{ width, height, 0, axis_coverage(width, kSize), axis_coverage(height, kSize) })
{
}
ThumbnailBuilder::~ThumbnailBuilder() = default;
ThumbnailBuilder::ThumbnailBuilder(ThumbnailBuilder&&) noexcept = default;
ThumbnailBuilder& ThumbnailBuilder::operator=(ThumbnailBuilder&&) noexcept = default;

/// Adds the shares of one row of pixels to the cells of `line`.
static void squash_row(const AxisCoverage& columns, const float* pixel, std::ptrdiff_t x_stride, double* line)
{
    std::fill(line, line + kSize * 3, 0.0);
    for (const AxisCoverage::Share& share : columns.shares) {
        const float* v = pixel + share.input * x_stride;
        double* cell = line + share.cell * 3;
        for (int c = 0; c < 3; ++c)
            cell[c] += share.length * v[c];
    }
}

void ThumbnailBuilder::add_rows(ImageView rows)
{
    State& s = *m_state;
    for (int y = 0; y < rows.height && s.next_row < s.height; ++y, ++s.next_row) {
        squash_row(s.columns, rows.pixel(0, y), rows.x_stride, s.line.data());
        for (int i = s.rows.first_share[s.next_row]; i < s.rows.first_share[s.next_row + 1]; ++i) {
            const AxisCoverage::Share& share = s.rows.shares[i];
            double* sums = s.sums.data() + share.cell * kSize * 3;
            for (int k = 0; k < kSize * 3; ++k)
                sums[k] += share.length * s.line[k];
        }
    }
}

Thumbnail ThumbnailBuilder::finish(int orientation) const
{
    const double cell_area = (m_state->width / double(kSize)) * (m_state->height / double(kSize));
    Thumbnail thumbnail;
    std::transform(m_state->sums.begin(), m_state->sums.end(), thumbnail.rgb.begin(),
                   [&](double sum) { return static_cast<float>(sum / cell_area); });
    return oriented(thumbnail, orientation);
}

Thumbnail make_thumbnail(ImageView image, int orientation)
{
    ThumbnailBuilder builder(image.width, image.height);
    builder.add_rows(image);
    return builder.finish(orientation);
}

Thumbnail oriented(const Thumbnail& thumbnail, int orientation)
{
    if (orientation < 2 || orientation > 8)
        return thumbnail;
    // EXIF: 2, 3, 4 mirror or turn by 180°; 5 … 8 swap the axes. (u, v): where the upright pixel (x, y) is stored.
    const bool swap = orientation >= 5;
    const bool flip_u = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    const bool flip_v = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    Thumbnail upright;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const int along = swap ? y : x, across = swap ? x : y;
            const int u = flip_u ? kSize - 1 - along : along, v = flip_v ? kSize - 1 - across : across;
            std::copy_n(thumbnail.view().pixel(u, v), 3, upright.rgb.data() + (y * kSize + x) * 3);
        }
    return upright;
}

} // namespace srisp
