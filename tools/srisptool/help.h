// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace srisp::tool {

/// What srisptool adds to oiiotool, with examples.
extern const char kHelp[];

} // namespace srisp::tool
