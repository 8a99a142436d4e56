// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <srisp/expected.h>

namespace srisp {

/// What the header of an ICC profile says (ICC.1:2022, 7.2), as far as it matters here.
struct IccHeader {
    std::uint32_t color_space = 0; ///< four characters, known to be one of ICC's
};

/// Checks the fields by which Little CMS goes, and that the tags lie in the profile: it takes numbers that stand for
/// nothing as values of its enumerations. Errors: "its ICC profile of 200 bytes is damaged: …".
Expected<IccHeader> read_icc_header(const void* profile, std::size_t size);

/// The four characters of a signature; what cannot be printed becomes '?'.
std::string icc_signature_text(std::uint32_t signature);

} // namespace srisp
