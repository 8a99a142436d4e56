// SPDX-License-Identifier: Apache-2.0
// Memory that runs out while transforms are made gives an error, and nothing is left behind.
#include "allocations.h"

#include <srisp/ocio_transform.h>

#include "ocio/ocio_pixels.h"

#if SRISP_COUNTS_ALLOCATIONS

using namespace srisp;

TEST_CASE("transforms and their CLF without memory for one large piece")
{
    constexpr std::size_t kLargePieces = 4 << 10; // OpenColorIO and nlohmann::json need the small ones
    const auto model = Model::load("default");
    REQUIRE(model);
    const Parameters parameters = sample_parameters(**model);
    const ClfLabel label{ "id", "name", { "what it is" } };
    for (const Direction direction : { Direction::reverse, Direction::forward }) {
        allocations::fail_each(kLargePieces, [&]() -> Expected<int> {
            const auto made = make_ocio_transform(**model, parameters, direction, kSmallestLut);
            return made ? Expected<int>((*made)->getNumTransforms()) : made.error();
        });
        allocations::fail_each(kLargePieces,
                               [&] { return make_clf(**model, parameters, direction, label, kSmallestLut); });
    }
    Development development;
    development.space = "ACEScg";
    allocations::fail_each(1 << 9, [&] { return make_development_clf(development, label); });
}

#endif
