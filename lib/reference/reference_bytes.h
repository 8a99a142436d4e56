// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>
#include <srisp/reference.h>

namespace srisp {

/// A reference but for its name and path as bytes, for the program at the other end of a pipe: same machine, same
/// version.
std::string bytes_of_reference(const Reference& reference);

/// The reference in such bytes. Errors: they are not what bytes_of_reference makes (the other program was misled by its
/// file), or hold values that no thumbnail has.
Expected<Reference> reference_of_bytes(const std::string& bytes);

} // namespace srisp
