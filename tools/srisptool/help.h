// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace srisp::tool {

/// What srisptool adds to oiiotool, with examples: made from the tables of its commands and of their options.
std::string help_text();

} // namespace srisp::tool
