// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/expected.h>

#include "base/file_bytes.h"

namespace srisp {

/// Whether LibRaw 0.20 may see a file: it does not check all that it reads. Errors, without the file's name: tags of a
/// mosaic of 36 filters that make it write without end over its own memory, wherever in the file they lie; a TIFF whose
/// folders of tags form a loop, nest without end, hold too many tags, or name further folders more than once, so that
/// it would read the same ones again and again.
Status check_libraw_traps(const FileBytes& file);

} // namespace srisp
