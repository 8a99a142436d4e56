// SPDX-License-Identifier: Apache-2.0
#include <srisp/options.h>

#include "base/near_names.h"

namespace srisp {

Expected<Precision> precision_from_name(const std::string& name)
{
    if (name == "float32")
        return Precision::float32;
    if (name == "fast")
        return Precision::fast;
    return Error{ "unknown precision '" + name + "'" + near_names(name, { "float32", "fast" }) };
}

Expected<InputEncoding> input_encoding_from_name(const std::string& name)
{
    if (name == "auto")
        return InputEncoding::automatic;
    if (name == "srgb")
        return InputEncoding::srgb;
    if (name == "linear")
        return InputEncoding::linear;
    return Error{ "unknown input '" + name + "'" + near_names(name, { "auto", "srgb", "linear" }) };
}

} // namespace srisp
