// SPDX-License-Identifier: Apache-2.0
#include "reference/decoders.h"

namespace srisp {

Expected<RawImage> decode_raw(const FileBytes& file)
{
    const auto dng = describe_dng(file);
    if (!dng)
        return dng.error();
    if (!*dng)
        return decode_with_libraw(file, nullptr);
    const DngDescription& description = **dng;
    if (description.is_float)
        return decode_float_dng(file, description);
    return description.lossy ? decode_lossy_dng(file, description) : decode_with_libraw(file, &description);
}

} // namespace srisp
