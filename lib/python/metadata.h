// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/imageio.h>

namespace srisp::python {

/// What an image says of itself, without its pixels: the attributes and names of an ImageSpec.
struct Metadata {
    OIIO::ImageSpec spec;
};

} // namespace srisp::python
