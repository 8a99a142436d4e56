// SPDX-License-Identifier: Apache-2.0
// DNGs of floats.
#include "raw_images.h"
#include "reference/decoders.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const FileBytes file = fuzz::file_of(data, size);
    const auto dng = describe_dng(file);
    if (!fuzz::is_accepted(dng) || !*dng || !(*dng)->is_float)
        return 0;
    if (const auto image = decode_float_dng(file, **dng); fuzz::is_accepted(image)) {
        fuzz::check_raw_image(*image);
        const RawPixels& pixels = image->pixels;
        for (int y = 0; y < pixels.height; ++y)
            for (int x = 0; x < pixels.width * pixels.pixel_stride; ++x)
                fuzz::must_hold(std::isfinite(pixels.floats[y * pixels.row_stride + x]), "samples are finite");
    }
    return 0;
}
