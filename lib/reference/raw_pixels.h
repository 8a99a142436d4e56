// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <srisp/camera.h>
#include <srisp/expected.h>
#include <srisp/image.h>

namespace srisp {

/// Colours of the sensor's filters, repeating from the active area's top left: `letters` (R, G, B) row by row.
struct CfaPattern {
    int rows = 0, columns = 0;
    std::string letters;

    /// 0, 1, 2 for R, G, B.
    int color(int row, int column) const
    {
        const char letter = letters[std::size_t(row % rows * columns + column % columns)];
        return letter == 'R' ? 0 : letter == 'G' ? 1 : 2;
    }
};

/// Black level of each sample: a pattern that repeats from the active area's top left (row by row, samples of a pixel
/// adjacent) plus a part per column and a part per row (both may be empty). [DNG 1.4, BlackLevel …]
struct BlackLevels {
    int rows = 1, columns = 1;
    std::vector<float> pattern;
    std::vector<float> by_column, by_row;

    /// Of one pixel of a mosaic.
    float at(int row, int column) const;
};

/// The active area of a decoded sensor image, as stored, before black and white are applied.
struct RawPixels {
    std::shared_ptr<const void> owner;     ///< of the samples
    const std::uint16_t* shorts = nullptr; ///< first sample of the active area; either this …
    const float* floats = nullptr;         ///< … or this, all finite
    std::ptrdiff_t row_stride = 0;         ///< samples from a row to the next one
    int pixel_stride = 1;                  ///< samples from a pixel to its right neighbour
    int channels = 1;                      ///< 1: mosaic with `cfa`; 3: R, G, B
    int width = 0, height = 0;
    CfaPattern cfa;
    BlackLevels black;
    std::array<float, 3> white{}; ///< per channel; the first one for a mosaic
};

/// What a decoder makes of a RAW file.
struct RawImage {
    RawPixels pixels;
    CameraFacts facts;
    std::vector<std::string> notes;
    bool lossy = false; ///< stored as lossy JPEGs, which took the noise away
};

/// target[i] = clamp01((source[i] − black[i]) · factor[i]), `count` values: what most of the time goes into when a
/// mosaic of many megapixels is reduced. Vectorised, dispatched at run time; the same bits on every instruction set.
void scale_shorts(const std::uint16_t* source, const float* black, const float* factor, std::size_t count,
                  float* target);

/// Turns stored rows into (value − black) / (white − black), clipped to [0,1].
class RowScaler {
public:
    /// `pixels` must outlive this object, and its levels must have passed `check_levels`.
    explicit RowScaler(const RawPixels& pixels);

    /// Writes width × channels values of one row. Threads: safe.
    void scale(int row, float* target) const;

private:
    template<class Sample> void scale_row(const Sample* source, int row, float* target) const;

    const RawPixels& m_pixels;
    std::vector<float> m_black, m_factor; ///< factor = 1 / (white − black); [row of the pattern][column][channel]
};

/// Whether these filters can be used. Errors: a colour that is not R, G or B, or none of one; X-Trans too small for its
/// pattern. Images of three channels pass.
Status check_filters(const RawPixels& pixels);

/// Whether these levels can be used. Errors such as "black level 2056 is not below white level 1023".
Status check_levels(const RawPixels& pixels);

/// Fills the facts that follow from the pixels: size, CFA pattern and levels.
void describe_levels(const RawPixels& pixels, CameraFacts& facts);

/// The thumbnail of a sensor image, as stored (not yet upright). A mosaic needs no demosaic: per colour the area
/// average over that colour's own sites; sensors under 512 px (a cell may hold no site of a colour) are demosaiced
/// bilinearly first. Same bits for any number of threads. [method: thumbnails]
Thumbnail raw_thumbnail(const RawPixels& pixels);

} // namespace srisp
