// SPDX-License-Identifier: Apache-2.0
// ICC profiles; the first byte says whether of grey.
#include "color/icc_header.h"
#include "color/icc_transform.h"
#include "fuzz_target.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    fuzz::Draws draws(data, size);
    const int channels = draws.number<char>() == 'g' ? 1 : 3;
    const std::string profile = draws.rest();
    if (const auto header = read_icc_header(profile.data(), profile.size()); fuzz::is_accepted(header))
        fuzz::must_hold(icc_signature_text(header->color_space).size() <= 4, "a signature has four characters");
    const auto transform = color_transform_from_icc(profile.data(), profile.size(), channels);
    if (!fuzz::is_accepted(transform) || !*transform)
        return 0;
    std::vector<float> colors;
    for (int i = 0; i < 27; ++i)
        for (const int level : { i / 9, i / 3 % 3, i % 3 })
            colors.push_back(float(channels == 1 ? i % 3 : level) / 2);
    (*transform)->apply(colors.data(), std::int64_t(colors.size() / 3));
    fuzz::must_be_in_unit_range(colors, "colours are in [0,1]");
    return 0;
}
