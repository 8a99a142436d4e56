// SPDX-License-Identifier: Apache-2.0
// DNGs of integers: what their tags say of levels, filters and areas, with samples that are not compressed.
#include "noise/estimate_noise.h"
#include "raw_images.h"
#include "reference/decoders.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const FileBytes file = fuzz::file_of(data, size);
    const auto dng = describe_dng(file);
    if (!fuzz::is_accepted(dng) || !*dng || (*dng)->is_float || (*dng)->lossy || (*dng)->compression != 1)
        return 0;
    const auto image = decode_with_libraw(file, &**dng);
    if (!fuzz::is_accepted(image))
        return 0;
    fuzz::check_raw_image(*image);
    if (fuzz::is_looked_at_closely(*image))
        fuzz::is_accepted(estimate_noise(image->pixels, 1));
    return 0;
}
