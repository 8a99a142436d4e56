// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace srisp::tool {

/// What srispbake --help prints.
extern const char kHelp[];

} // namespace srisp::tool
