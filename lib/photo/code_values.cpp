// SPDX-License-Identifier: Apache-2.0
#include "photo/code_values.h"

#include <array>
#include <memory>

#include <OpenImageIO/imageio.h>

namespace srisp {

template<class Code> const float* code_values()
{
    constexpr std::size_t count = kCodeCount<Code>;
    // Never destroyed: other threads may still read while statics end.
    static const float* const values = [] {
        std::array<Code, count> codes;
        for (std::size_t i = 0; i < count; ++i)
            codes[i] = static_cast<Code>(i);
        auto floats = std::make_unique<float[]>(count);
        const OIIO::TypeDesc type = sizeof(Code) == 1 ? OIIO::TypeUInt8 : OIIO::TypeUInt16;
        OIIO::convert_pixel_values(type, codes.data(), OIIO::TypeFloat, floats.get(), int(count));
        return floats.release();
    }();
    return values;
}

template const float* code_values<std::uint8_t>();
template const float* code_values<std::uint16_t>();

} // namespace srisp
