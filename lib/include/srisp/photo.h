// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>
#include <srisp/export.h>

namespace srisp {

/// How the stored values of a photo are to be read.
enum class InputEncoding {
    automatic, ///< what the file says: integer and "sRGB" are display-encoded, float and "Linear" are linear
    srgb,      ///< display-encoded
    linear     ///< linear sRGB primaries; encoded with the sRGB curve before use
};

/// Reads "auto", "srgb" or "linear"; an error names all three.
SRISP_API Expected<InputEncoding> input_encoding_from_name(const std::string& name);

/// Turns the stored channels of one photo into display-encoded sRGB, and results back into its channels. Grey becomes
/// three equal channels; alpha is divided out before and multiplied in after; an ICC profile is converted to sRGB;
/// linear photos are encoded; values above 1 or below 0 are clipped and counted. Threads: const functions are safe.
class SRISP_API PhotoConverter {
public:
    /// `spec`: the photo's spec as an OpenImageIO reader gives it. `where`: its name in messages. Errors: CMYK or other
    /// colour models that are not RGB or grey, deep images, a broken ICC profile, volumes.
    static Expected<PhotoConverter> create(const OIIO::ImageSpec& spec, InputEncoding encoding,
                                           const std::string& where);
    ~PhotoConverter();
    PhotoConverter(PhotoConverter&&) noexcept;
    PhotoConverter& operator=(PhotoConverter&&) noexcept;

    /// The spec of the result: float R, G, B, then alpha and the other channels of the photo that are not colour;
    /// windows, tiles and orientation as in the photo; what describes the photo's own encoding (ICC profile, …) erased.
    const OIIO::ImageSpec& output_spec() const;

    /// `stored`: `pixels` × spec.nchannels floats → `rgb`: `pixels` × 3, display-encoded, in [0,1]. Errors: NaN or
    /// infinity.
    Status to_rgb(const float* stored, std::int64_t pixels, float* rgb) const;
    /// `rgb` (3 floats per pixel) and the `stored` pixels they came from → `out`, output_spec().nchannels floats per
    /// pixel.
    void from_rgb(const float* rgb, const float* stored, std::int64_t pixels, float* out) const;

    /// Values that to_rgb has clipped so far.
    std::int64_t clipped_values() const;
    /// What was assumed or ignored, one sentence each.
    const std::vector<std::string>& notes() const;

private:
    struct State;
    explicit PhotoConverter(std::unique_ptr<State> state);
    std::unique_ptr<State> m_state;
};

} // namespace srisp
