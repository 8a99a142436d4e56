// SPDX-License-Identifier: Apache-2.0
#include "result/computed_image.h"

#include "result/developed_image.h"
#include "result/result_image.h"
#include "result/sensor_image.h"
#include "result/stored_image.h"

namespace srisp {

namespace {

template<class Image> Expected<std::unique_ptr<ComputedImage>> as_computed(Expected<std::unique_ptr<Image>> image)
{
    if (!image)
        return image.error();
    return std::unique_ptr<ComputedImage>(std::move(*image));
}

} // namespace

Expected<std::unique_ptr<ComputedImage>> open_computed_image(const Recipe& recipe, std::unique_ptr<PixelSource> source,
                                                             const OIIO::ImageSpec& config, KeptResults& kept)
{
    const std::string name = source->name();
    const bool stored = recipe.action == Recipe::Action::sensor || recipe.action == Recipe::Action::develop;
    auto image = stored ? as_computed(StoredImage::open(std::move(source)))
                        : as_computed(ResultImage::open(recipe, std::move(source), config, kept));
    if (image && (recipe.mosaic || !recipe.noise.empty()))
        image = as_computed(SensorImage::open(recipe, name, std::move(*image), kept));
    if (image && !recipe.develop.empty())
        image = as_computed(DevelopedImage::open(recipe, name, std::move(*image), kept));
    return image;
}

} // namespace srisp
