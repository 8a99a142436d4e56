// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <srisp/expected.h>

#include "gain_map/find_gain_map.h"
#include "gain_map/gain_map_image.h"

namespace srisp {

/// Makes the HDR picture of a photo by its gain map, as on a display that shows all of it. Immutable.
class GainMap {
public:
    /// `width`, `height`: of the photo as stored, which the map (of any size) covers, not turned either. Errors: the
    /// map's image is damaged; Apple's map; the photo is HDR already; the boost counts in other primaries than the
    /// photo's, so that channels would have to be mixed.
    static Expected<GainMap> create(const GainMapInfo& info, int width, int height);

    /// Row y of the photo: linear light in the photo's own primaries, 3 floats a pixel, 1 is SDR white, → the same in
    /// HDR, 1 is SDR white still. Values may be below 0 by the metadata's offset_hdr. May be in place.
    void boosted(int y, const float* sdr, float* hdr) const;

private:
    /// Where along an axis a pixel of the photo is among the map's: between two neighbours.
    struct Position {
        int first, second;
        float weight; ///< of the second
    };
    /// From the map's value to the factor of linear light, for one channel.
    struct Boost {
        std::vector<float> factors;
        float offset_sdr, offset_hdr;

        Boost(const GainMapMetadata& metadata, std::size_t channel);
        float factor(float value) const;
        float applied(float sdr, float factor) const { return (sdr + offset_sdr) * factor - offset_hdr; }
    };

    GainMap(GainMapImage image, const GainMapMetadata& metadata, int width, int height);
    static std::vector<Position> positions(int pixels, int map_pixels);

    GainMapImage m_image;
    std::vector<Position> m_columns, m_rows;
    std::vector<Boost> m_boosts; ///< of R, G, B
    bool m_one_factor;           ///< for all channels of a pixel
};

} // namespace srisp
