// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <srisp/dng.h>

#include "base/byte_sink.h"

namespace srisp {

/// write_dng to any place; what `sink` itself could not do it knows. Errors without a name.
Expected<std::vector<std::string>> write_dng(ByteSink& sink, const DngImage& image, const DngOptions& options);

} // namespace srisp
