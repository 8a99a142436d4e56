// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "color/color_transform.h"

namespace srisp {

/// How the colour values of an image are to be read.
struct ColorReading {
    ColorTransformPtr transform;    ///< null: they are display-encoded sRGB already
    std::vector<std::string> notes; ///< what was assumed or ignored, one sentence each
};

/// Display-encoded sRGB, whatever the image says.
ColorReading read_as_srgb();

/// Linear light with sRGB's primaries, whatever the image says.
ColorReading read_as_linear();

/// What the image says, in this order: the name of a linear colour space (`oiio:ColorSpace`; where that says no
/// primaries, and no chromaticities are there, `colorInteropID`), `CICP` (four integers,
/// ITU-T H.273), `ICCProfile`, the name of an encoded one with `chromaticities`; where none of these is known, float is
/// linear and integers are sRGB. What cannot be used is passed over with a note. `channels`: of colour, 1 or 3.
ColorReading read_as_described(const OIIO::ImageSpec& spec, int channels);

} // namespace srisp
