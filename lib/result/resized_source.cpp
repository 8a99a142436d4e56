// SPDX-License-Identifier: Apache-2.0
#include "result/resized_source.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include "base/hashes.h"
#include "container/image_limits.h"
#include "container/image_memory.h"
#include "recipe/photo_size.h"

namespace srisp {

namespace {

class ResizedSource : public PixelSource {
public:
    ResizedSource(std::unique_ptr<PixelSource> photo, OIIO::ImageSpec spec, std::vector<float> pixels, std::string key)
        : m_photo(std::move(photo)), m_spec(std::move(spec)), m_pixels(std::move(pixels)), m_key(std::move(key))
    {
    }

    std::optional<OIIO::ImageSpec> find_level(int subimage, int miplevel) override
    {
        return subimage == 0 && miplevel == 0 ? std::optional(m_spec) : std::nullopt;
    }
    Status read_rows(int, int, int y0, int y1, float* rows) override
    {
        const std::size_t row = std::size_t(m_spec.width) * std::size_t(m_spec.nchannels);
        std::copy(m_pixels.data() + row * std::size_t(y0), m_pixels.data() + row * std::size_t(y1), rows);
        return {};
    }
    const std::string& name() const override { return m_photo->name(); }
    const std::string& key() const override { return m_key; }
    const std::vector<std::string>& notes() const override { return m_photo->notes(); }

private:
    std::unique_ptr<PixelSource> m_photo;
    OIIO::ImageSpec m_spec;
    std::vector<float> m_pixels;
    std::string m_key;
};

void set_size(OIIO::ImageSpec& spec, int width, int height)
{
    spec.x = spec.y = spec.full_x = spec.full_y = 0;
    spec.width = spec.full_width = width;
    spec.height = spec.full_height = height;
    spec.tile_width = spec.tile_height = 0;
}

/// The photo as codes and as floats, and what is made of it. `wanted`: 0 x 0 where the size stays.
Status check_resizing(const OIIO::ImageSpec& spec, const PhotoSize& wanted)
{
    if (wanted.width > 0)
        if (const Status sides = check_sides(std::uint64_t(wanted.width), std::uint64_t(wanted.height)); !sides)
            return Error{ "resized it " + sides.error().message };
    const std::uint64_t result = std::uint64_t(wanted.width) * std::uint64_t(wanted.height);
    return check_memory(2 * std::uint64_t(spec.image_pixels()) + result, spec.nchannels);
}

} // namespace

Expected<std::unique_ptr<PixelSource>> resized_source(std::unique_ptr<PixelSource> photo, const Recipe& recipe)
{
    const auto found = photo->find_level(0, 0);
    if (!found)
        return Error{ photo->name() + ": holds no picture" };
    if (photo->gain_map())
        return Error{ photo->name() +
                      ": its gain map has the size of the whole photo; no resize, no crop with gainmap" };
    OIIO::ImageSpec spec = *found;
    // What is asked for is upright; pixels lie as the camera was held.
    const bool turned = spec.get_int_attribute("Orientation", 1) > 4;
    const auto upright = [&](int width, int height) {
        return turned ? PhotoSize{ height, width } : PhotoSize{ width, height };
    };
    const PhotoSize stored{ spec.width, spec.height };
    const PhotoSize wanted =
        recipe.resize.empty() ? PhotoSize{} : resized(recipe.resize, upright(stored.width, stored.height));
    if (const Status fits = check_resizing(spec, wanted); !fits)
        return Error{ photo->name() + ": " + fits.error().message };

    OIIO::ImageSpec layout(spec.width, spec.height, spec.nchannels, OIIO::TypeFloat);
    std::vector<float> pixels(spec.image_pixels() * std::size_t(spec.nchannels));
    if (const Status read = photo->read_rows(0, 0, 0, spec.height, pixels.data()); !read)
        return read.error();

    if (!recipe.resize.empty()) {
        const PhotoSize size = upright(wanted.width, wanted.height);
        const OIIO::ImageBuf whole(layout, pixels.data());
        OIIO::ImageBuf small;
        const bool done = OIIO::ImageBufAlgo::resize(small, whole, "", 0.0f,
                                                     { 0, size.width, 0, size.height, 0, 1, 0, spec.nchannels }, 1);
        layout = OIIO::ImageSpec(size.width, size.height, spec.nchannels, OIIO::TypeFloat);
        std::vector<float> values(layout.image_pixels() * std::size_t(spec.nchannels));
        if (!done || !small.get_pixels(small.roi(), OIIO::TypeFloat, values.data()))
            return Error{ photo->name() + ": cannot be resized: " + small.geterror() };
        pixels = std::move(values);
    }
    if (!recipe.crop.empty()) {
        const PhotoSize size = upright(layout.width, layout.height);
        const auto part = cropped(recipe.crop, size, seeded_hash(recipe.seed, recipe.photo_name()));
        if (!part)
            return Error{ photo->name() + ": " + part.error().message };
        const OIIO::ImageBuf whole(layout, pixels.data());
        const PhotoSize left = upright(part->width, part->height), at = upright(part->x, part->y);
        layout = OIIO::ImageSpec(left.width, left.height, spec.nchannels, OIIO::TypeFloat);
        std::vector<float> values(layout.image_pixels() * std::size_t(spec.nchannels));
        whole.get_pixels(
            { at.width, at.width + left.width, at.height, at.height + left.height, 0, 1, 0, spec.nchannels },
            OIIO::TypeFloat, values.data());
        pixels = std::move(values);
    }
    // Sharp filters overshoot beside edges; a photo has no such values.
    if (spec.format != OIIO::TypeFloat && spec.format != OIIO::TypeHalf)
        for (float& value : pixels)
            value = std::clamp(value, 0.0f, 1.0f);
    set_size(spec, layout.width, layout.height);
    const std::string key = photo->key() + "\nresize=" + recipe.resize + "\ncrop=" + recipe.crop + "\n" +
                            (recipe.crop.empty() ? "" : std::to_string(recipe.seed));
    return std::unique_ptr<PixelSource>(
        std::make_unique<ResizedSource>(std::move(photo), std::move(spec), std::move(pixels), key));
}

} // namespace srisp
