// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace srisp::tool {

/// What a file format can hold of a linear image.
enum class Depth {
    any,     ///< float, or not known to srisptool
    sixteen, ///< integers of 16 bits at most; oiiotool would write 8 unless told
    eight    ///< 8 bits at most
};

/// By the extension of a file name, or the name of a format.
Depth deepest(const std::string& name);

} // namespace srisp::tool
