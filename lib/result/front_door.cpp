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

/// What a writer is told of an image.
OIIO::ImageSpec file_spec(const OIIO::ImageOutput& output, const OIIO::ImageSpec& image, OIIO::TypeDesc type)
{
    OIIO::ImageSpec spec = image;
    spec.set_format(type == OIIO::TypeUnknown ? stored_type(output.format_name()) : type);
    const int orientation = spec.get_int_attribute("Orientation", 1);
    if (output.format_name() == std::string("png") && orientation > 1 && orientation <= 8)
        spec.attribute(kPngOrientationKey, std::to_string(orientation) + kPngOrientationRest);
    spec.tile_width = spec.tile_height = 0; // tiles of the photo may have a size that this writer refuses
    return spec;
}

Status write_file(OIIO::ImageOutput& output, const std::string& path, const OIIO::ImageSpec& spec, const float* pixels)
{
    if (output.open(path, spec) && output.write_image(OIIO::TypeFloat, pixels) && output.close())
        return {};
    const std::string reason = output.geterror();
    return Error{ reason.empty() ? "its writer does not say why" : reason };
}

Error write_error(const std::string& path, const std::string& reason)
{
    return { "image '" + path + "' cannot be written: " + reason };
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
        auto output = OIIO::ImageOutput::create(path);
        if (!output)
            return write_error(path, OIIO::geterror());
        NamedOutput file(path);
        Status written = file.created();
        if (written && output->supports("ioproxy")) {
            // OpenEXR's writer says nothing of a disk that gets full while it closes a file.
            const auto bytes = encode(path, type);
            if (!bytes)
                return bytes.error();
            written = store(file.name(), *bytes);
        } else if (written) {
            written = write_file(*output, file.name(), file_spec(*output, m_spec, type), m_pixels.data());
        }
        output.reset();
        if (written)
            written = file.finish();
        return written ? written : Status(write_error(path, written.error().message));
    });
}

Expected<std::vector<unsigned char>> Image::encode(const std::string& name, OIIO::TypeDesc type,
                                                   const std::string& compression) const
{
    return guarded("image", name, [&]() -> Expected<std::vector<unsigned char>> {
        const auto output = OIIO::ImageOutput::create(name);
        if (!output)
            return write_error(name, OIIO::geterror());
        OIIO::Filesystem::IOVecOutput memory;
        if (!output->supports("ioproxy") || !output->set_ioproxy(&memory))
            return write_error(name, std::string("OpenImageIO's writer of ") + output->format_name() +
                                         " files writes to disks only");
        OIIO::ImageSpec spec = file_spec(*output, m_spec, type);
        if (!compression.empty())
            spec.attribute("compression", compression);
        const Status written = write_file(*output, name, spec, m_pixels.data());
        output->set_ioproxy(nullptr);
        if (!written)
            return write_error(name, written.error().message);
        std::vector<unsigned char> bytes = std::move(memory.buffer());
        if (output->format_name() == std::string("png"))
            place_png_orientation(bytes);
        return bytes;
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
