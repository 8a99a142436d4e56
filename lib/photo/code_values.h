// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <OpenImageIO/typedesc.h>

namespace srisp {

/// How many codes an integer type has.
template<class Code> constexpr std::size_t kCodeCount = std::size_t(1) << (8 * sizeof(Code));

/// The float that OpenImageIO makes of each code of an integer type of 8 or 16 bits.
template<class Code> const float* code_values();
extern template const float* code_values<std::uint8_t>();
extern template const float* code_values<std::uint16_t>();

template<class Code> void codes_to_floats(const Code* codes, std::size_t count, float* values)
{
    const float* const value_of = code_values<Code>();
    for (std::size_t i = 0; i < count; ++i)
        values[i] = value_of[codes[i]];
}

/// Whether pixels of a type are such codes.
inline bool are_codes(OIIO::TypeDesc type)
{
    return type == OIIO::TypeUInt8 || type == OIIO::TypeUInt16;
}

} // namespace srisp
