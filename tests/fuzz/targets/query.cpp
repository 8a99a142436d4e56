// SPDX-License-Identifier: Apache-2.0
// Queries: lines of key=value; and what the values' texts mean.
#include "fuzz_target.h"
#include "recipe/brightness.h"
#include "recipe/frame_pattern.h"
#include "recipe/noise_source.h"
#include "recipe/option_table.h"
#include "recipe/photo_size.h"
#include "recipe/white_balance.h"

using namespace srisp;

namespace {

void check_sizes(const Recipe& recipe)
{
    const PhotoSize small = resized(recipe.resize, { 3, 70000 });
    fuzz::must_hold(small.width >= 1 && small.height >= 1, "a size has pixels");
    const auto part = cropped(recipe.crop, { 640, 480 }, recipe.seed);
    if (fuzz::is_accepted(part))
        fuzz::must_hold(part->x >= 0 && part->y >= 0 && part->width >= 1 && part->height >= 1 &&
                            part->x + part->width <= 640 && part->y + part->height <= 480,
                        "a crop lies in the photo");
}

void check_noise(const std::string& text)
{
    const auto noise = parse_noise_source(text);
    if (fuzz::is_accepted(noise))
        for (int c = 0; c < 3; ++c)
            fuzz::must_hold(noise->shot[c] >= 0 && noise->shot[c] <= 1 && noise->read[c] >= 0 && noise->read[c] <= 1,
                            "figures of noise are in [0,1]");
}

void check_frames(const std::string& text)
{
    const FrameWildcard wildcard = find_frame_wildcard(text);
    fuzz::must_hold(wildcard.begin + wildcard.length <= text.size(), "a wildcard lies in the name");
    with_frame(frame_pattern_of_file(text), "12");
    with_frame(frame_pattern_of_image(text), "");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    fuzz::Draws draws(data, size);
    Recipe recipe;
    for (int i = 0; i < 16 && !draws.at_end(); ++i) {
        const std::string key = draws.line(), value = draws.line();
        fuzz::is_accepted(set_by_text(recipe, key, value));
        fuzz::is_accepted(set_option(recipe, key, value));
        check_noise(value);
        check_frames(value);
    }
    check_sizes(recipe);
    fuzz::must_hold(recipe.exposure >= -20 && recipe.exposure <= 20, "exposure is within its limits");
    fuzz::is_accepted(check_complete(recipe, "query"));
    return 0;
}
