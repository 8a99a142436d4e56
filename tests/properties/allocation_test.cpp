// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include <doctest/doctest.h>
#include <srisp/apply.h>
#include <srisp/model.h>

#include "allocations.h"
#include "random_model.h"

#if SRISP_COUNTS_ALLOCATIONS

using namespace srisp;

TEST_CASE("more tiles need no more allocations")
{
    ScratchFolder folder;
    for (const int kernel_size : { 3, 1 })
        for (const Precision precision : { Precision::float32, Precision::fast }) {
            const auto model = Model::load(random_model(kernel_size, 1).write(folder.path("random.safetensors")));
            REQUIRE(model);
            Parameters parameters;
            parameters.model_hash = (*model)->hash();
            parameters.tone_weights.fill({ 0.1f, 0.3f, 0.2f, 0.25f, 0.15f });
            parameters.gamma = 2.2f;
            parameters.color = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
            parameters.white_balance = { 2, 1, 1.5f };
            parameters.gain = 1.3f;
            const auto applier = Applier::create(**model, parameters, Direction::reverse, precision);
            REQUIRE(applier);
            const auto allocations_of = [&](int width, int height) {
                std::vector<float> in(std::size_t(3) * width * height, 0.5f), out(in.size());
                const MutableImageView source{ in.data(), width, height, 3, std::ptrdiff_t(3) * width };
                const MutableImageView target{ out.data(), width, height, 3, std::ptrdiff_t(3) * width };
                ApplyOptions options;
                options.threads = 1;
                const long before = allocations::count;
                REQUIRE((*applier)->run(source, target, options));
                return allocations::count - before;
            };
            if (kernel_size == 1) {
                allocations_of(800, 700); // makes the table
                CHECK(allocations_of(800, 700) == allocations_of(1000, 1400));
            }
            const long few = allocations_of(40, 40);
            CHECK((few > 0) == (kernel_size == 3)); // rows between layers
            CHECK(allocations_of(400, 600) == few);
        }
}

#endif
