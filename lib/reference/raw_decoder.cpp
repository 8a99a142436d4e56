// SPDX-License-Identifier: Apache-2.0
#include "reference/decoders.h"

#include "container/image_memory.h"

namespace srisp {

Expected<RawImage> decode_raw(const FileBytes& file)
{
    const auto dng = describe_dng(file);
    if (!dng)
        return dng.error();
    if (!*dng)
        return decode_with_libraw(file, nullptr);
    const DngDescription& description = **dng;
    const std::uint64_t pixels = std::uint64_t(description.stored_width) * std::uint64_t(description.stored_height);
    if (const Status fits = check_memory(pixels, description.samples); !fits)
        return fits.error();
    if (description.is_float)
        return decode_float_dng(file, description);
    return description.lossy ? decode_lossy_dng(file, description) : decode_with_libraw(file, &description);
}

} // namespace srisp
