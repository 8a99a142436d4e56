// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <srisp/expected.h>

#include "../scores.h"
#include "base/byte_sink.h"

namespace srisp::tool {

/// The pictures of one test image, all of one size.
struct ImagePictures {
    int width = 0, height = 0;
    std::string photo; ///< bytes of a JPEG file
    /// Linear camera RGB in 16 bits as bytes of a PNG file of 8 bits, twice as high: its upper half holds the high
    /// bytes of R, G, B, its lower half the low ones; 65535 is 1. Empty: there is none.
    std::string truth;
    std::string reference; ///< likewise, of a size of its own: reference_width × reference_height
    int reference_width = 0, reference_height = 0;
    std::map<std::string, std::string> results;              ///< likewise, by method
    std::array<float, 3> white_balance{ 1, 1, 1 };           ///< multipliers of R, G, B that make white white
    std::array<float, 9> color{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }; ///< row-major: balanced camera RGB → linear sRGB
};

/// The report as one HTML file that needs nothing else. `shown`: indices into evaluation.images of those that are shown
/// with pictures, the worst first; `pictures(i)` gives those of image i, each asked for once, in this order.
Status write_report(const Evaluation& evaluation, const std::vector<std::size_t>& shown,
                    const std::function<Expected<ImagePictures>(std::size_t)>& pictures, ByteSink& out);

} // namespace srisp::tool
