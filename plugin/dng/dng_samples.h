// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/dng.h>
#include <srisp/expected.h>
#include <srisp/mosaic.h>

#include "color/color_transform.h"
#include "dng_settings.h"
#include "record/record.h"

namespace srisp::plugin {

/// The samples of a DNG, made row by row of what a host gives.
class DngSamples {
public:
    /// `spec`: the host's, with the type that its pixels had. Errors: other than one or three channels, a mosaic whose
    /// phase is not said, levels that cannot be.
    static Expected<DngSamples> create(const OIIO::ImageSpec& spec, const DngSettings& settings);

    /// `row` from 0; `values`: width × channels floats. Errors: NaN and infinity, with their place.
    Status put(int row, const float* values);

    /// Rows that were not put yet.
    int missing() const { return m_missing; }

    /// Views of the samples and what they are; valid as long as this object.
    DngImage image() const;

    /// The camera RGB of a small picture of it, upright as the samples are: at most `most` pixels a side. Empty: the
    /// image is too small for one.
    struct Picture {
        int width = 0, height = 0;
        std::vector<float> rgb;
    };
    Picture picture(int most) const;

    /// What was assumed or clipped, one sentence each.
    std::vector<std::string> notes() const;

private:
    /// A sample = black + value · range, where a value is (stored − from) · scale.
    struct Level {
        float from = 0, scale = 1, black = 0, range = 1;
    };

    DngSamples(const OIIO::ImageSpec& spec, const DngSettings& settings);
    Status set_mosaic(const OIIO::ImageSpec& spec);
    Status set_colors(const OIIO::ImageSpec& spec);
    void take_photo(const OIIO::ImageSpec& spec);
    std::size_t level_of(int x, int y, int channel) const;
    float value_of(int x, int y, int channel) const;

    int m_width, m_height, m_channels;
    DngSettings m_settings;
    CameraFacts m_facts;
    BayerPhase m_phase = BayerPhase::rggb; ///< of the first pixel
    std::array<Level, 4> m_levels;         ///< of a mosaic by place (row · 2 + column), else by channel
    float m_white = 1;
    ColorTransformPtr m_to_srgb; ///< of a photo that is not encoded as sRGB
    bool m_is_photo = false;
    std::vector<std::uint16_t> m_shorts;
    std::vector<float> m_floats;
    std::vector<bool> m_done;
    int m_missing;
    std::int64_t m_clipped = 0;
    std::vector<std::string> m_notes;
};

} // namespace srisp::plugin
