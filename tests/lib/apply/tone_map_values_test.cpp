// SPDX-License-Identifier: Apache-2.0
#include <srisp/apply.h>

#include <doctest/doctest.h>
#include <srisp/model.h>

#include "image_compare.h"
#include "random_model.h"

using namespace srisp;

namespace {

std::shared_ptr<const Model> load(const ScratchFolder& folder, int kernel_size)
{
    const auto model = Model::load(random_model(kernel_size, 7).write(folder.path("m.safetensors")));
    REQUIRE_MESSAGE(model, (model ? "" : model.error().message));
    return *model;
}

Parameters plain_parameters(const Model& model)
{
    Parameters p;
    const std::vector<float> even(model.dictionary_size(), 1.0f / model.dictionary_size());
    p.tone_weights.fill(even);
    p.gamma_weights = p.color_weights = p.white_balance_weights = p.gain_weights = even;
    p.model_name = model.name();
    p.model_hash = model.hash();
    return p;
}

} // namespace

TEST_CASE("tone map values, clamped, are what apply gives where all other blocks are the identity")
{
    const ScratchFolder folder;
    const auto model = load(folder, 1);
    const Parameters parameters = plain_parameters(*model);
    Random random(1);
    std::vector<float> rgb(3 * 1000), values(rgb.size()), applied(rgb.size());
    for (float& value : rgb)
        value = random.uniform(0, 1);
    for (const Direction direction : { Direction::reverse, Direction::forward }) {
        const Status status = tone_map_values(*model, parameters, direction, rgb.data(), 1000, values.data());
        REQUIRE_MESSAGE(status, status.error().message);
        const auto applier = Applier::create(*model, parameters, direction);
        REQUIRE(applier);
        REQUIRE((*applier)->run(ImageView{ rgb.data(), 1000, 1, 3, 3000 },
                                MutableImageView{ applied.data(), 1000, 1, 3, 3000 }));
        int outside = 0;
        for (float& value : values) {
            outside += value < 0 || value > 1;
            value = std::min(std::max(value, 0.0f), 1.0f);
        }
        const Difference difference = compare(values, applied);
        INFO(difference.text);
        CHECK(difference.largest <= 2e-5);
        CHECK(outside > 0); // values are not clamped
    }
}

TEST_CASE("tone map values of a model that looks at neighbours are refused")
{
    const ScratchFolder folder;
    const auto model = load(folder, 3);
    float rgb[3] = { 0, 0, 0 };
    const Status status = tone_map_values(*model, plain_parameters(*model), Direction::reverse, rgb, 1, rgb);
    REQUIRE(!status);
    CHECK(status.error().message.find("looks at 3 x 3 pixels") != std::string::npos);
}
