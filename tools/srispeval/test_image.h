// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pixels.h"
#include "raw_picture.h"
#include "report/report_page.h"
#include "scores.h"

namespace srisp::tool {

/// A photo to be unprocessed with a reference, and where there is one the truth.
struct TestImage {
    ImageScore score; ///< what names it; without the methods' results
    Pixels photo;     ///< display-encoded sRGB in [0,1]
    Pixels truth;     ///< linear camera RGB, of the photo's size; empty: none is known
    Pixels reference; ///< linear camera RGB
    RawColors colors; ///< of the reference's camera; the truth's white balance where there is a truth
};

} // namespace srisp::tool
