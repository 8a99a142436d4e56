// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/srisp.h>

namespace srisp {

/// Tells a sink what will come. `where` starts the error ("photo 'a.jpg'"): the sink keeps all rows, and they are more
/// than one image may take.
Status begin_image(const ImageSink& sink, const OIIO::ImageSpec& spec, const std::string& where);

} // namespace srisp
