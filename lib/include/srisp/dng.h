// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <srisp/camera.h>
#include <srisp/expected.h>
#include <srisp/export.h>

namespace srisp {

/// An image to be written as a DNG: views of pixels, and what readers are told of them.
struct DngImage {
    int width = 0, height = 0;             ///< pixels, at most 65535 a side
    int planes = 1;                        ///< 1: a mosaic; 3: R, G, B (LinearRaw), interleaved
    const std::uint16_t* shorts = nullptr; ///< either these samples …
    const float* floats = nullptr;         ///< … or these, of three planes
    std::ptrdiff_t row_stride = 0;         ///< samples from a row to the next one
    std::string cfa_pattern;               ///< of a mosaic: "RGGB", "GRBG", "GBRG" or "BGGR"
    /// Black levels, repeating from the top left: row by row, the planes of a pixel adjacent.
    int black_rows = 1, black_columns = 1;
    std::vector<float> black;             ///< empty: 0
    std::array<std::uint32_t, 3> white{}; ///< per plane; 0: the largest sample of so many bits, of floats 1

    /// Make, model, matrices, orientation, as-shot neutral, exposure, noise profile; its sizes, phase and levels are
    /// not looked at. What is not known is left out, or neutral where readers demand it.
    CameraFacts facts;
    float baseline_exposure = 0; ///< EV
    std::string description, xmp;
    std::string date_time, artist, copyright; ///< as TIFF has them; empty: not known

    /// An sRGB picture of it, 8 bits, rows of `3 · preview_width` bytes; no larger than the image. Null: none.
    const std::uint8_t* preview = nullptr;
    int preview_width = 0, preview_height = 0;
};

enum class DngCompression { none, lossless, deflate };
enum class DngLayout { standard, cinema };

/// How a DNG is written.
struct DngOptions {
    /// Lossless JPEG for integers; floats have none or Deflate. Integers with Deflate are refused: few programs read
    /// them.
    DngCompression compression = DngCompression::lossless;
    int bits = 16; ///< of integers 10 to 16; of floats 16 or 32
    /// `standard`: the preview first, the RAW image in a SubIFD (without a preview: in the first folder). `cinema`:
    /// one folder and no preview, as CinemaDNG has it.
    DngLayout layout = DngLayout::standard;
    int threads = 0; ///< 0: as many as OpenImageIO uses
};

/// Writes a DNG; the file is complete or absent, a device or pipe is written to as it is. Gives notes on what was
/// assumed or left out, one sentence each. The bytes are the same for any number of threads. Errors name the file:
/// sizes, levels and phases that cannot be, samples of more bits, NaN and infinity, a compression that does not go with
/// the samples, what the file system says. [DNG 1.4; CinemaDNG 1.1]
SRISP_API Expected<std::vector<std::string>> write_dng(const std::string& path, const DngImage& image,
                                                       const DngOptions& options = {});

} // namespace srisp
