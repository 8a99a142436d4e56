// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/image.h>

namespace srisp {

/// Which filters lie over pixel (0, 0) of an image, its right neighbour, and the two below them. Bit 0 of the number:
/// shifted by a column against RGGB; bit 1: shifted by a row.
enum class BayerPhase { rggb = 0, grbg = 1, gbrg = 2, bggr = 3 };

/// From a camera's or a user's text (upper or lower case). Errors: any other text, X-Trans and other filters of more
/// pixels, no filters (a demosaiced image).
SRISP_API Expected<BayerPhase> parse_bayer_phase(const std::string& text);

/// "RGGB", …
SRISP_API std::string bayer_phase_text(BayerPhase phase);

/// Where a piece of a mosaic lies: the phase is that of the whole image's pixel (0, 0); the piece's first pixel is
/// (x, y) of the whole image (below 0, too). So pieces fit together, whatever their offsets.
struct MosaicPlace {
    BayerPhase phase = BayerPhase::rggb;
    int x = 0, y = 0;

    /// The phase of the piece by itself, which a file that holds it alone must name.
    BayerPhase phase_here() const { return BayerPhase(int(phase) ^ (x & 1) ^ ((y & 1) << 1)); }
};

/// 0, 1, 2 for R, G, B: the filter over pixel (x, y) of an image of this phase.
inline int bayer_color(BayerPhase phase, int x, int y)
{
    return ((int(phase) ^ x) & 1) + (((int(phase) >> 1) ^ y) & 1);
}

/// Which of CameraFacts' four black levels (R, first G, B, second G) is that of such a filter: the second green is the
/// one in odd rows.
inline std::size_t bayer_level(BayerPhase phase, int x, int y)
{
    const int color = bayer_color(phase, x, y);
    return color == 1 && (y & 1) ? 3 : std::size_t(color);
}

/// A view of one plane of float32; it owns nothing.
template<class Float> struct BasicPlaneView {
    Float* data;             ///< pixel (0, 0)
    int width, height;       ///< pixels
    std::ptrdiff_t x_stride; ///< floats from a pixel to its right neighbour
    std::ptrdiff_t y_stride; ///< floats from a row to the next one

    Float* pixel(int x, int y) const { return data + x * x_stride + y * y_stride; }
    operator BasicPlaneView<const Float>() const { return { data, width, height, x_stride, y_stride }; }
};
using PlaneView = BasicPlaneView<const float>;
using MutablePlaneView = BasicPlaneView<float>;

/// What a sensor with Bayer filters sees of a linear camera RGB image: of each pixel the channel of its filter,
/// unchanged (NaN, too). `place`: of both. Any size; `threads` 0: as many as OpenImageIO uses. Error: target of another
/// size.
SRISP_API Status make_mosaic(ImageView image, MosaicPlace place, MutablePlaneView target, int threads = 0);

} // namespace srisp
