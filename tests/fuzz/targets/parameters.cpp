// SPDX-License-Identifier: Apache-2.0
// Parameters as JSON.
#include <srisp/parameters.h>

#include "fuzz_target.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto read = parameters_from_json(fuzz::text_of(data, size), "file");
    if (!fuzz::is_accepted(read))
        return 0;
    fuzz::must_hold(read->gain > 0 && read->gamma > 0, "accepted values can be applied");
    for (const int indent : { -1, 2 }) {
        const std::string text = to_json(*read, indent);
        const auto again = parameters_from_json(text, "file");
        fuzz::must_hold(bool(again), "what was written can be read", text);
        fuzz::must_hold(to_json(*again, indent) == text, "values come back to the bit", text);
        fuzz::must_hold(again->color == read->color && again->tone_weights == read->tone_weights,
                        "values come back to the bit");
    }
    return 0;
}
