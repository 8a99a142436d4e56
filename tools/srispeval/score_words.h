// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scores.h"

// Words that tables and reports share.

namespace srisp::tool {

/// "1 image", "2 images".
std::string counted(int count, const std::string& noun);

/// "PSNR, dB", filled up with spaces to 20 characters.
std::string padded_title(const Metric& metric);

} // namespace srisp::tool
