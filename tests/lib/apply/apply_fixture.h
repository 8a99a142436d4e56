// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <doctest/doctest.h>
#include <srisp/apply.h>
#include <srisp/model.h>

#include "random_model.h"

// Images, a small model and its parameters, for the tests of apply.

namespace srisp {

struct Image {
    int width, height, channels = 3;
    std::vector<float> values = std::vector<float>(std::size_t(width) * height * channels);

    MutableImageView view() { return { values.data(), width, height, channels, std::ptrdiff_t(channels) * width }; }
};

inline Image random_image(int width, int height)
{
    Image image{ width, height };
    Random random(width * 1000 + height);
    for (float& value : image.values)
        value = random.uniform(0, 1);
    return image;
}

/// A model, and parameters of it that look like those of a photo.
struct Fixture {
    ScratchFolder folder;
    std::shared_ptr<const Model> model;
    Parameters parameters;

    explicit Fixture(int kernel_size = 3)
    {
        Expected<std::shared_ptr<const Model>> loaded =
            Model::load(random_model(kernel_size, 1).write(folder.path("random.safetensors")));
        REQUIRE_MESSAGE(loaded, (loaded ? "" : loaded.error().message));
        model = *loaded;
        parameters.model_hash = model->hash();
        parameters.tone_weights.fill({ 0.1f, 0.3f, 0.2f, 0.25f, 0.15f });
        parameters.gamma = 2.2f;
        parameters.color = { 1.6f, -0.4f, -0.2f, -0.3f, 1.5f, -0.2f, 0.05f, -0.6f, 1.55f };
        parameters.white_balance = { 2.1f, 1, 1.6f };
        parameters.gain = 1.3f;
    }

    std::shared_ptr<const Applier> applier(Direction direction = Direction::reverse,
                                           Precision precision = Precision::float32) const
    {
        Expected<std::shared_ptr<const Applier>> result = Applier::create(*model, parameters, direction, precision);
        REQUIRE_MESSAGE(result, (result ? "" : result.error().message));
        return *result;
    }
};

inline ApplyOptions on_threads(int threads)
{
    ApplyOptions options;
    options.threads = threads;
    return options;
}

inline Image applied(const Applier& applier, Image source, int threads = 1)
{
    Image target{ source.width, source.height };
    const Status status = applier.run(source.view(), target.view(), on_threads(threads));
    REQUIRE_MESSAGE(status, status.error().message);
    return target;
}

} // namespace srisp
