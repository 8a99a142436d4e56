// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cctype>

#include <srisp/mosaic.h>

#include "base/guarded.h"
#include "base/near_names.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

const std::array<std::string, 4> kPhases{ "RGGB", "GRBG", "GBRG", "BGGR" }; // by their numbers

} // namespace

Expected<BayerPhase> parse_bayer_phase(const std::string& text)
{
    return guarded("phase", {}, [&]() -> Expected<BayerPhase> {
        std::string letters = text;
        std::transform(letters.begin(), letters.end(), letters.begin(),
                       [](unsigned char c) { return std::toupper(c); });
        const auto found = std::find(kPhases.begin(), kPhases.end(), letters);
        if (found != kPhases.end())
            return BayerPhase(found - kPhases.begin());
        const std::string known = "only Bayer phases can be made: RGGB, GRBG, GBRG, BGGR";
        if (text.empty())
            return Error{ "an image without filters names no phase; " + known };
        constexpr std::size_t kXTrans = 36; // filters
        if (letters == "X-TRANS" || letters == "XTRANS" ||
            (text.size() == kXTrans && letters.find_first_not_of("RGB") == std::string::npos))
            return Error{ "X-Trans filters (" + shown_text(text) + "): " + known };
        return Error{ "unknown phase '" + shown_text(text) + "'" +
                      near_names(letters, { kPhases.begin(), kPhases.end() }) + " (" + known + ")" };
    });
}

std::string bayer_phase_text(BayerPhase phase)
{
    return kPhases[std::size_t(phase)];
}

} // namespace srisp
