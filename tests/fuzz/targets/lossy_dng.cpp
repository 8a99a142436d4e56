// SPDX-License-Identifier: Apache-2.0
// DNGs of lossy JPEGs, and the curves that make them linear.
#include "raw_images.h"
#include "reference/decoders.h"
#include "reference/dng_curves.h"

using namespace srisp;

namespace {

void check_curves(const std::string& opcodes)
{
    const DngCurves curves(opcodes);
    for (const int channels : { 1, 3 })
        for (int y = 0; y < 3; ++y) {
            std::vector<float> row;
            for (int i = 0; i < 8 * channels; ++i)
                row.push_back(float(i) / float(8 * channels - 1));
            curves.apply(y, 8, channels, row.data());
            fuzz::must_be_in_unit_range(row, "curves give values in [0,1]");
        }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const FileBytes file = fuzz::file_of(data, size);
    const auto dng = describe_dng(file);
    if (size > 0 && data[0] == 0)
        check_curves(fuzz::text_of(data, size));
    if (!fuzz::is_accepted(dng) || !*dng || !(*dng)->lossy)
        return 0;
    check_curves((*dng)->lossy->opcodes);
    if (const auto image = decode_lossy_dng(file, **dng); fuzz::is_accepted(image))
        fuzz::check_raw_image(*image);
    return 0;
}
