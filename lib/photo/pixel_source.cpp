// SPDX-License-Identifier: Apache-2.0
#include "photo/pixel_source.h"

namespace srisp {

OIIO::ImageSpec reading_hints(const Options& options, const OIIO::ImageSpec& config)
{
    OIIO::ImageSpec hints = config;
    if (options.allow_partial)
        hints.attribute("srisp:allow_partial", 1);
    if (!options.isolate)
        hints.attribute("srisp:isolate", 0);
    if (options.gain_map == GainMapUse::apply)
        hints.attribute("srisp:gainmap", "apply");
    return hints;
}

} // namespace srisp
