// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace srisp::tool {

/// Whether a path's last part is a name that oiiotool writes to before it renames: `….XXXXXXXX.temp.ext` with eight
/// hexadecimal digits. Folders do not matter, nor what else is in the name.
bool is_unfinished_output(std::string_view path);

} // namespace srisp::tool
