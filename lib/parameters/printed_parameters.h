// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace srisp {

/// What srisptool --srisp-params printed, for parameters_from_json: the image's name in it is there for people. Any
/// other text comes back as it is.
std::string without_image_name(const std::string& text);

} // namespace srisp
