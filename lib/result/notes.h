// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <srisp/photo.h>

namespace srisp {

/// What clipping and replacing changed, one sentence each; empty if nothing.
std::vector<std::string> notes_of(const PhotoCounts& counts);

/// Prints `srisp: note: image: text` on stderr, each once per process (hosts open a file several times per read).
void print_notes(const std::string& image, const std::vector<std::string>& notes);

} // namespace srisp
