// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include <srisp/expected.h>

namespace srisp {

/// Where the figures of noise come from.
struct NoiseSource {
    enum class Kind {
        reference, ///< the reference's NoiseProfile, or the noise in its own pixels
        iso,       ///< a table of cameras
        figures,   ///< given
        upi        ///< drawn at random
    };
    Kind kind = Kind::reference;
    double iso = 0;
    std::array<double, 3> shot{}, read{}; ///< given ones, of R, G, B: 0 to 1
};

/// From a user's text: `reference`, `iso=800`, `shot=0.01,read=1e-4` (one figure each, or three for R, G, B:
/// `shot=0.01,0.008,0.012,read=1e-4`), `upi`. Errors: any other text, figures that cannot be, an ISO that is not above
/// 0.
Expected<NoiseSource> parse_noise_source(const std::string& text);

} // namespace srisp
