// SPDX-License-Identifier: Apache-2.0
// Plain samples without a header: the JSON text that describes them, a zero byte, and the samples.
#include "raw_images.h"
#include "reference/decoders.h"
#include "reference/sample_layout.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    fuzz::Draws draws(data, size);
    const auto layout = parse_sample_layout(draws.line(), "plate.json");
    if (!fuzz::is_accepted(layout))
        return 0;
    const std::string samples = draws.rest();
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(samples.data());
    if (const auto image = decode_plain_samples(fuzz::file_of(bytes, samples.size()), *layout);
        fuzz::is_accepted(image))
        fuzz::check_raw_image(*image);
    return 0;
}
