// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "base/byte_sink.h"

namespace srisp::tool {

/// Writes bytes as base64 [RFC 4648], with padding and without line ends, piece by piece: a picture is not held twice.
void write_base64(ByteSink& out, std::string_view bytes);

} // namespace srisp::tool
