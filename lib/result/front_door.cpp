// SPDX-License-Identifier: Apache-2.0
#include <srisp/srisp.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <OpenImageIO/filesystem.h>

#include "base/guarded.h"
#include "base/named_output.h"
#include "base/png_orientation.h"
#include "recipe/recipe.h"
#include "result/computed_image.h"
#include "result/kept_results.h"
#include "result/recipe_source.h"

namespace srisp {

namespace {

/// As much of a value as a kind of file can hold; a writer takes the nearest that it has.
OIIO::TypeDesc stored_type(const std::string& format)
{
    if (format == "openexr")
        return OIIO::TypeHalf;
    const char* const floats[] = { "tiff", "fits", "hdr" };
    return std::count(std::begin(floats), std::end(floats), format) ? OIIO::TypeFloat : OIIO::TypeUInt16;
}

Status store(const std::string& path, const std::vector<unsigned char>& bytes)
{
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    bool stored = file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && std::fflush(file) == 0;
    const int error = errno;
    if (file && std::fclose(file) != 0)
        stored = false;
    return stored ? Status() : Status(Error{ std::strerror(error) });
}

Status write_image(OIIO::ImageOutput& output, const std::string& path, const OIIO::ImageSpec& image,
                   OIIO::TypeDesc type, const float* pixels)
{
    OIIO::ImageSpec spec = image;
    spec.set_format(type == OIIO::TypeUnknown ? stored_type(output.format_name()) : type);
    const int orientation = spec.get_int_attribute("Orientation", 1);
    const bool png = output.format_name() == std::string("png");
    if (png && orientation > 1 && orientation <= 8)
        spec.attribute(kPngOrientationKey, std::to_string(orientation) + kPngOrientationRest);
    spec.tile_width = spec.tile_height = 0; // tiles of the photo may have a size that this writer refuses
    // Into memory where the writer can: OpenEXR's says nothing of a disk that gets full while it closes a file.
    OIIO::Filesystem::IOVecOutput memory;
    const bool in_memory = output.supports("ioproxy") && output.set_ioproxy(&memory);
    const bool written = output.open(path, spec) && output.write_image(OIIO::TypeFloat, pixels) && output.close();
    const std::string reason = written ? "" : output.geterror();
    output.set_ioproxy(nullptr);
    if (!written)
        return Error{ reason.empty() ? "its writer does not say why" : reason };
    if (in_memory)
        if (const Status stored = store(path, memory.buffer()); !stored)
            return stored;
    if (png)
        place_png_orientation(path.c_str());
    return {};
}

Expected<Image> result_of(const Recipe& recipe)
{
    // Never destroyed: other threads may still read while statics end.
    static KeptResults& kept = *new KeptResults;
    auto source = open_recipe_source(recipe, {});
    if (!source)
        return source.error();
    if (const Status complete = check_complete(recipe, (*source)->name()); !complete)
        return complete.error();
    const auto result = open_computed_image(recipe, std::move(*source), {}, kept);
    if (!result)
        return result.error();
    constexpr int kAllThreads = 0;
    const auto found = (*result)->full_spec(0, 0, kAllThreads);
    if (!found)
        return found.error();
    const OIIO::ImageSpec spec = **found;
    const std::size_t row = std::size_t(spec.width) * spec.nchannels;
    std::vector<float> pixels(row * spec.height);
    const Status read = (*result)->read(0, 0, kAllThreads, 0, spec.width, 0, spec.height, pixels.data(), row);
    if (!read)
        return read.error();
    return Image(spec, std::move(pixels));
}

} // namespace

Status Image::save(const std::string& path, OIIO::TypeDesc type) const
{
    return guarded("image", path, [&]() -> Status {
        const std::string where = "image '" + path + "' cannot be written";
        auto output = OIIO::ImageOutput::create(path);
        if (!output)
            return Error{ where + ": " + OIIO::geterror() };
        NamedOutput file(path);
        Status written = file.created();
        if (written)
            written = write_image(*output, file.name(), m_spec, type, m_pixels.data());
        output.reset();
        if (written)
            written = file.finish();
        return written ? written : Status(Error{ where + ": " + written.error().message });
    });
}

Expected<Image> unprocess(const std::string& photo_path, const std::string& reference_path, const Options& options)
{
    return guarded("photo", photo_path, [&] {
        Recipe recipe;
        static_cast<Options&>(recipe) = options;
        recipe.source = photo_path;
        if (!reference_path.empty())
            recipe.references = { reference_path };
        return result_of(recipe);
    });
}

Expected<Image> process(const std::string& raw_path, const Options& options)
{
    return guarded("image", raw_path, [&] {
        Recipe recipe;
        static_cast<Options&>(recipe) = options;
        recipe.source = raw_path;
        recipe.direction = Direction::forward;
        return result_of(recipe);
    });
}

Expected<Image> develop(const std::string& raw_path, const Options& options)
{
    return guarded("image", raw_path, [&] {
        Recipe recipe;
        static_cast<Options&>(recipe) = options;
        recipe.source = raw_path;
        recipe.action = Recipe::Action::develop;
        if (recipe.develop.empty())
            recipe.develop = "ACEScg";
        return result_of(recipe);
    });
}

} // namespace srisp
