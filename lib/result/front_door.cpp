// SPDX-License-Identifier: Apache-2.0
#include <srisp/srisp.h>

#include <algorithm>

#include "base/guarded.h"
#include "recipe/recipe.h"
#include "result/computed_image.h"
#include "result/image_sink.h"
#include "result/kept_results.h"
#include "result/photo_image.h"
#include "result/recipe_source.h"

namespace srisp {

namespace {

/// Rows at a time: of whole blocks of EXR's, some megabytes.
int band_rows(const OIIO::ImageSpec& spec)
{
    constexpr std::size_t kValues = 1 << 20;
    constexpr int kBlock = 32;
    const std::size_t row = std::size_t(spec.width) * std::size_t(spec.nchannels);
    return std::max(int(kValues / row) / kBlock, 1) * kBlock;
}

Expected<std::unique_ptr<ComputedImage>> open_image(const Recipe& recipe, const MemoryImage* memory)
{
    // Never destroyed: other threads may still read while statics end.
    static KeptResults& kept = *new KeptResults;
    auto source = open_recipe_source(recipe, {}, memory);
    if (!source)
        return source.error();
    if (memory && recipe.gain_map == GainMapUse::apply)
        return Error{ (*source)->name() + ": gainmap=apply reads a gain map from the photo's file; this has none" };
    if (const Status complete = check_complete(recipe, (*source)->name()); !complete)
        return complete.error();
    OIIO::ImageSpec hints;
    if (recipe.straight_alpha)
        hints.attribute("oiio:UnassociatedAlpha", 1);
    return open_computed_image(recipe, std::move(*source), hints, kept);
}

Status pass_result(Recipe recipe, const MemoryImage* memory, const ImageSink& sink)
{
    const std::string where = "photo '" + (memory ? recipe.name : recipe.source) + "'";
    recipe.cancelled = sink.cancelled;
    const auto result = open_image(recipe, memory);
    if (!result)
        return result.error();
    const auto found = (*result)->full_spec(0, 0, recipe.threads);
    if (!found)
        return found.error();
    const OIIO::ImageSpec spec = **found;
    if (const Status begun = begin_image(sink, spec, where); !begun)
        return begun;
    const std::size_t row = std::size_t(spec.width) * std::size_t(spec.nchannels);
    const int step = band_rows(spec);
    std::vector<float> rows(row * std::size_t(std::min(step, spec.height)));
    for (int y = 0; y < spec.height; y += step) {
        if (sink.cancelled && sink.cancelled())
            return Error{ "cancelled" };
        const int end = std::min(y + step, spec.height);
        if (const Status read = (*result)->read(0, 0, recipe.threads, 0, spec.width, y, end, rows.data(), row); !read)
            return read;
        if (const Status taken = sink.rows(rows.data(), end - y); !taken)
            return taken;
    }
    return {};
}

/// A whole image of what `pass` gives to a sink.
template<class Pass> Expected<Image> image_of(const Pass& pass)
{
    OIIO::ImageSpec spec;
    std::vector<float> pixels;
    ImageSink sink;
    sink.holds_all = true;
    sink.begin = [&](const OIIO::ImageSpec& known) -> Status {
        spec = known;
        pixels.reserve(spec.image_pixels() * std::size_t(spec.nchannels));
        return {};
    };
    sink.rows = [&](const float* rows, int count) -> Status {
        pixels.insert(pixels.end(), rows,
                      rows + std::size_t(count) * std::size_t(spec.width) * std::size_t(spec.nchannels));
        return {};
    };
    const Status passed = pass(sink);
    return passed ? Expected<Image>(Image(std::move(spec), std::move(pixels))) : passed.error();
}

Recipe recipe_of(const ImageInput& input, const Options& options)
{
    Recipe recipe;
    static_cast<Options&>(recipe) = options;
    (input.memory() ? recipe.name : recipe.source) = input.name();
    return recipe;
}

} // namespace

Status unprocess(const ImageInput& photo, const ReferenceInput& reference, const Options& options,
                 const ImageSink& sink)
{
    return guarded("photo", photo.name(), [&] {
        Recipe recipe = recipe_of(photo, options);
        recipe.reference = reference.loaded;
        if (!reference.path.empty())
            recipe.references = { reference.path };
        return pass_result(recipe, photo.memory(), sink);
    });
}

Status process(const ImageInput& raw, const Options& options, const ImageSink& sink)
{
    return guarded("image", raw.name(), [&] {
        Recipe recipe = recipe_of(raw, options);
        recipe.direction = Direction::forward;
        return pass_result(recipe, raw.memory(), sink);
    });
}

Status develop(const ImageInput& raw, const Options& options, const ImageSink& sink)
{
    return guarded("image", raw.name(), [&] {
        Recipe recipe = recipe_of(raw, options);
        recipe.action = Recipe::Action::develop;
        if (recipe.develop.empty())
            recipe.develop = "ACEScg";
        return pass_result(recipe, raw.memory(), sink);
    });
}

Status sense(const ImageInput& raw, const Options& options, const ImageSink& sink)
{
    return guarded("image", raw.name(), [&] {
        Recipe recipe = recipe_of(raw, options);
        recipe.action = Recipe::Action::sensor;
        return pass_result(recipe, raw.memory(), sink);
    });
}

Status read_photo(const ImageInput& photo, const Options& options, const ImageSink& sink)
{
    return guarded("photo", photo.name(), [&]() -> Status {
        const Recipe recipe = recipe_of(photo, options);
        const auto source = open_recipe_source(recipe, {}, photo.memory());
        return source ? pass_photo(**source, options, sink) : Status(source.error());
    });
}

Expected<Image> unprocess(const ImageInput& photo, const ReferenceInput& reference, const Options& options)
{
    return image_of([&](const ImageSink& sink) { return unprocess(photo, reference, options, sink); });
}
Expected<Image> process(const ImageInput& raw, const Options& options)
{
    return image_of([&](const ImageSink& sink) { return process(raw, options, sink); });
}
Expected<Image> develop(const ImageInput& raw, const Options& options)
{
    return image_of([&](const ImageSink& sink) { return develop(raw, options, sink); });
}
Expected<Image> sense(const ImageInput& raw, const Options& options)
{
    return image_of([&](const ImageSink& sink) { return sense(raw, options, sink); });
}
Expected<Image> read_photo(const ImageInput& photo, const Options& options)
{
    return image_of([&](const ImageSink& sink) { return read_photo(photo, options, sink); });
}

} // namespace srisp
