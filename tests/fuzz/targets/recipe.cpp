// SPDX-License-Identifier: Apache-2.0
// Recipes and jobs as JSON; the first byte says which.
#include "recipe/recipe.h"

#include "fuzz_target.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    fuzz::Draws draws(data, size);
    const bool is_job = draws.number<char>() == 'j';
    auto recipe = recipe_from_json(draws.rest(), "/nowhere/a.srisp", is_job);
    if (!fuzz::is_accepted(recipe))
        return 0;
    fuzz::must_hold(is_job || !recipe->source.empty(), "a recipe has a source");
    take_as_development(*recipe);
    fuzz::is_accepted(check_complete(*recipe, "recipe"));
    return 0;
}
