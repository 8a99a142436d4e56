// SPDX-License-Identifier: Apache-2.0
// Images that are linear references: EXR and TIFF, by their first bytes.
#include "memory_file.h"
#include "raw_images.h"
#include "reference/decoders.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static fuzz::MemoryFile file;
    const bool tiff = size > 0 && (data[0] == 'I' || data[0] == 'M');
    const auto reference = read_linear_reference(file.holding(data, size), tiff ? "tiff" : "openexr");
    if (fuzz::is_accepted(reference))
        fuzz::must_be_in_unit_range(reference->thumbnail.rgb, "a thumbnail's values are in [0,1]");
    return 0;
}
