// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/srisp.h>

#include "batch_options.h"

namespace srisp::tool {

/// An image as a NumPy file, version 1.0: height × width × channels, or height × width of one channel, C order,
/// little-endian. uint16: values in [0,1] times 65535.
std::string npy_bytes(const Image& image, OutputDepth depth);

} // namespace srisp::tool
