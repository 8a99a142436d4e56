// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace srisp {

/// For messages about an unknown name: "; did you mean 'a' or 'b'?" with the known names that are near (at most three,
/// nearest first), or "; known: a, b, c" where none is, or "" where none are known. Of many or long names only as much
/// is looked at, and shown, as takes no time.
std::string near_names(const std::string& name, const std::vector<std::string>& known);

} // namespace srisp
