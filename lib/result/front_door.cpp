// SPDX-License-Identifier: Apache-2.0
#include <srisp/srisp.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/guarded.h"
#include "base/named_output.h"
#include "recipe/recipe.h"
#include "result/computed_image.h"
#include "result/file_encoder.h"
#include "result/kept_results.h"
#include "result/recipe_source.h"

namespace srisp {

namespace {

Status store(const std::string& path, const std::vector<unsigned char>& bytes)
{
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    bool stored = file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && std::fflush(file) == 0;
    const int error = errno;
    if (file && std::fclose(file) != 0)
        stored = false;
    return stored ? Status() : Status(Error{ std::strerror(error) });
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

/// Rows at a time: of whole blocks of EXR's, some megabytes.
int band_rows(const OIIO::ImageSpec& spec)
{
    constexpr std::size_t kValues = 1 << 20;
    constexpr int kBlock = 32;
    const std::size_t row = std::size_t(spec.width) * std::size_t(spec.nchannels);
    return std::max(int(kValues / row) / kBlock, 1) * kBlock;
}

Status pass_result(const Recipe& recipe, const ImageSink& sink)
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
    if (const Status begun = sink.begin(spec); !begun)
        return begun;
    const std::size_t row = std::size_t(spec.width) * std::size_t(spec.nchannels);
    const int step = band_rows(spec);
    std::vector<float> rows(row * std::size_t(std::min(step, spec.height)));
    for (int y = 0; y < spec.height; y += step) {
        const int end = std::min(y + step, spec.height);
        if (const Status read = (*result)->read(0, 0, kAllThreads, 0, spec.width, y, end, rows.data(), row); !read)
            return read;
        if (const Status taken = sink.rows(rows.data(), end - y); !taken)
            return taken;
    }
    return {};
}

Expected<Image> result_of(const Recipe& recipe)
{
    OIIO::ImageSpec spec;
    std::vector<float> pixels;
    ImageSink sink;
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
    const Status passed = pass_result(recipe, sink);
    return passed ? Expected<Image>(Image(std::move(spec), std::move(pixels))) : passed.error();
}

Recipe unprocess_recipe(const std::string& photo_path, const std::string& reference_path, const Options& options)
{
    Recipe recipe;
    static_cast<Options&>(recipe) = options;
    recipe.source = photo_path;
    if (!reference_path.empty())
        recipe.references = { reference_path };
    return recipe;
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
        auto encoder = FileEncoder::create(name);
        if (!encoder)
            return write_error(name, encoder.error().message);
        Status written = encoder->begin(m_spec, type, compression);
        if (written)
            written = encoder->add_rows(m_pixels.data(), m_spec.height);
        auto bytes = written ? encoder->finish() : Expected<std::vector<unsigned char>>(written.error());
        if (!bytes)
            return write_error(name, bytes.error().message);
        return bytes;
    });
}

Expected<Image> unprocess(const std::string& photo_path, const std::string& reference_path, const Options& options)
{
    return guarded("photo", photo_path,
                   [&] { return result_of(unprocess_recipe(photo_path, reference_path, options)); });
}

Status unprocess(const std::string& photo_path, const std::string& reference_path, const Options& options,
                 const ImageSink& sink)
{
    return guarded("photo", photo_path,
                   [&] { return pass_result(unprocess_recipe(photo_path, reference_path, options), sink); });
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
