// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/srisp.h>

#include "photo/pixel_source.h"

namespace srisp {

/// Passes on what selection and the model see of a photo: display-encoded sRGB in [0,1], colour straight, then alpha
/// and other channels as they are; as stored (`Orientation` says how it is turned). Of the options `input` and
/// `threads` count.
Status pass_photo(PixelSource& source, const Options& options, const ImageSink& sink);

} // namespace srisp
