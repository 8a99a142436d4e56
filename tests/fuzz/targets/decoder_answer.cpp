// SPDX-License-Identifier: Apache-2.0
// What srispdecode answers: a reference or figures of noise as bytes.
#include "fuzz_target.h"
#include "noise/file_noise.h"
#include "reference/reference_bytes.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string bytes = fuzz::text_of(data, size);
    if (const auto noise = noise_of_bytes(bytes); fuzz::is_accepted(noise))
        fuzz::must_hold(bytes_of_noise(*noise) == bytes, "noise comes back to the bit");
    if (const auto reference = reference_of_bytes(bytes); fuzz::is_accepted(reference)) {
        fuzz::must_hold(bytes_of_reference(*reference) == bytes, "a reference comes back to the bit");
        fuzz::must_be_in_unit_range(reference->thumbnail.rgb, "a thumbnail's values are in [0,1]");
    }
    // A thumbnail is far longer than what a fuzzer makes, so one is put where the input has room for it.
    if (size < 8)
        return 0;
    Reference reference;
    fuzz::Draws draws(data, size);
    const std::size_t at = draws.number<std::uint32_t>();
    std::string damaged = bytes_of_reference(reference);
    const std::string piece = draws.rest();
    const std::size_t middle = damaged.size() / 2; // the thumbnail lies there
    const std::size_t place = at % 2 ? std::min(at % 64, middle) : damaged.size() - 1 - at % 160;
    damaged.replace(place, piece.size(), piece);
    fuzz::is_accepted(reference_of_bytes(damaged));
    return 0;
}
