// SPDX-License-Identifier: Apache-2.0
// RAW files of all kinds, by the decoder that is for them; mostly LibRaw.
#include "raw_images.h"
#include "reference/decoders.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (const auto image = decode_raw(fuzz::file_of(data, size)); fuzz::is_accepted(image))
        fuzz::check_raw_image(*image);
    return 0;
}
