// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <srisp/photo.h>

namespace srisp {

/// What clipping and replacing changed, one sentence each; empty if nothing.
std::vector<std::string> notes_of(const PhotoCounts& counts);

} // namespace srisp
