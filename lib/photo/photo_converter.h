// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>
#include <srisp/options.h>

namespace srisp {

/// What `PhotoConverter::to_rgb` had to change.
struct PhotoCounts {
    std::int64_t values = 0;   ///< colour values seen
    std::int64_t clipped = 0;  ///< outside [0,1] (of sRGB), set to the nearer end
    std::int64_t replaced = 0; ///< not a number, set to 0

    PhotoCounts& operator+=(const PhotoCounts& other);
    /// What clipping and replacing changed, one sentence each; empty if nothing.
    std::vector<std::string> notes() const;
};

/// Turns the stored channels of one image into display-encoded sRGB, and results back into its channels. Grey becomes
/// three equal channels; associated alpha is divided out before and multiplied in after; other colours than
/// display-encoded sRGB are converted (read_as_described says by what); values outside its 0 to 1 are clipped, NaN
/// becomes 0, both counted. Threads: an object is immutable, so any number of threads may use it.
class PhotoConverter {
public:
    /// `spec`: as an OpenImageIO reader gives it; `oiio:UnassociatedAlpha` in it says that colour is straight. `where`:
    /// the image's name in messages. Errors: CMYK and other colour models that are not RGB or grey, no colour channels,
    /// deep images, volumes, an image that is RAW-like already.
    static Expected<PhotoConverter> create(const OIIO::ImageSpec& spec, InputEncoding encoding,
                                           const std::string& where);
    ~PhotoConverter();
    PhotoConverter(PhotoConverter&&) noexcept;
    PhotoConverter& operator=(PhotoConverter&&) noexcept;

    /// The spec of the result: float R, G, B, then alpha (associated, OpenImageIO's convention) and the other channels
    /// of the photo that are not colour; windows, tiles and attributes as in the photo (record_result erases those that
    /// no longer hold).
    const OIIO::ImageSpec& output_spec() const;

    /// Whether pixels are stored as R, G and B and nothing else: `from_rgb` changes nothing then.
    bool is_rgb_alone() const;

    /// `stored`: `pixels` × spec.nchannels floats → `rgb`: `pixels` × 3, display-encoded, in [0,1]. Adds to `counts`.
    /// Both may be the same memory where pixels are RGB alone.
    void to_rgb(const float* stored, std::int64_t pixels, float* rgb, PhotoCounts& counts) const;

    /// `rgb` (3 floats per pixel) and the `stored` pixels they came from → `out`, output_spec().nchannels floats per
    /// pixel. `associate`: multiply alpha in; false for a host that asked for straight colour. Channels that are not
    /// colour are carried as they are.
    void from_rgb(const float* rgb, const float* stored, std::int64_t pixels, bool associate, float* out) const;

    /// What was assumed or ignored, one sentence each.
    const std::vector<std::string>& notes() const;

private:
    struct State;
    explicit PhotoConverter(std::unique_ptr<const State> state);
    std::unique_ptr<const State> m_state;
};

} // namespace srisp
