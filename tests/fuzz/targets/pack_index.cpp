// SPDX-License-Identifier: Apache-2.0
// The index of a training pack.
#include "pack/training_pack_index.h"

#include "fuzz_target.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto index = parse_pack_index(fuzz::text_of(data, size), "pack");
    if (!fuzz::is_accepted(index))
        return 0;
    const std::string text = format_pack_index(*index);
    const auto again = parse_pack_index(text, "pack");
    fuzz::must_hold(bool(again), "what was written can be read", again ? "" : again.error().message);
    fuzz::must_hold(format_pack_index(*again) == text, "an index comes back as it was");
    for (const auto* images : { &index->photos, &index->raws })
        if (*images)
            for (const PackEntry& entry : pack_entries(**images))
                for (const float side : entry.crop)
                    fuzz::must_hold(side >= 0 && side <= 1, "crops lie in their image");
    return 0;
}
