// SPDX-License-Identifier: Apache-2.0
#include "image_task.h"

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include <srisp/srisp.h>

#include "../common/own_location.h"
#include "base/hashes.h"
#include "base/json_text.h"
#include "base/output_file.h"
#include "npy_file.h"
#include "reference/reference_cache.h"
#include "shot_parameters.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// What making an image takes at most, by its header; 0 where that cannot be read: it will fail.
std::uint64_t memory_for(const std::string& photo)
{
    constexpr std::uint64_t kBytesPerPixel = 48; // codes, floats of bands, the result, its stored form
    std::error_code ignored;
    if (!fs::is_regular_file(photo, ignored))
        return 0;
    // A reader of films takes "pipe:0.mp4" for something else than a file.
    const auto input = OIIO::ImageInput::open(fs::absolute(photo).string());
    if (!input) {
        OIIO::geterror();
        return 0;
    }
    return std::uint64_t(input->spec().image_pixels()) * kBytesPerPixel;
}

Expected<std::string> encoded(const Image& image, const std::string& name, const MakingOptions& options)
{
    if (options.format == OutputFormat::npy)
        return npy_bytes(image, options.depth);
    static const OIIO::TypeDesc kStored[] = { OIIO::TypeHalf, OIIO::TypeFloat, OIIO::TypeUInt16 };
    const auto bytes = image.encode(name, kStored[int(options.depth)], options.compression);
    if (!bytes)
        return bytes.error();
    return std::string(bytes->begin(), bytes->end());
}

/// What the library is asked for.
Expected<Options> options_for(const BatchTask& task, const MakingOptions& options)
{
    Options image = options.image;
    image.seed = image.noise_seed = task.seed;
    if (task.parameters) {
        image.parameters = task.parameters;
        image.brightness = {}; // they are as bright as they became
    } else if (task.shot) {
        const auto parameters = shot_parameters(*task.shot, task.reference, task.shot_seed, options.image);
        if (!parameters)
            return parameters.error();
        image.parameters = *parameters;
        image.brightness = {};
    }
    return image;
}

/// Puts a file in its place, unless the same is there.
Status place(const std::string& bytes, const std::string& hash, const std::string& path, bool may_replace)
{
    std::error_code error;
    if (!may_replace && fs::exists(path, error)) {
        const auto there = hash_of_file(path);
        if (!there)
            return there.error();
        if (*there != hash)
            return Error{ "output '" + path + "' exists, and srispbatch did not make it so; --overwrite replaces it" };
        return {};
    }
    const fs::path folder = fs::path(path).parent_path();
    if (!folder.empty() && !fs::create_directories(folder, error) && error)
        return Error{ "folder '" + folder.string() + "' cannot be made: " + error.message() };
    const Status written = write_output_file(path, bytes);
    return written ? written : Status(Error{ "output " + written.error().message });
}

} // namespace

void prepare_making(OutputFormat format, std::size_t most_references)
{
    // Photos at a time fill the processor; each by itself has one thread.
    OIIO::attribute("threads", 1);
    // Of what a writer leaves out of a camera's notes Debian's OpenImageIO tells each time.
    if (!std::getenv("OPENIMAGEIO_DEBUG"))
        OIIO::attribute("debug", 0);
    // The writer of DNG files is a plugin.
    if (format == OutputFormat::dng)
        OIIO::attribute("plugin_searchpath", plugin_folder().string());
    set_most_kept_references(most_references);
}

Expected<ordered_json> run_task(const BatchTask& task, const std::string& path, const MakingOptions& options,
                                const std::string& settings, bool may_replace, const AskForMemory& ask)
{
    ask(memory_for(task.photo.path));
    const auto start = std::chrono::steady_clock::now();
    const auto image_options = options_for(task, options);
    if (!image_options)
        return image_options.error();
    const auto image = unprocess(task.photo.path, task.reference, *image_options);
    if (!image)
        return image.error();
    const auto bytes = encoded(*image, path, options);
    if (!bytes)
        return bytes.error();
    const std::string hash = hash_of_bytes(bytes->data(), bytes->size());
    const auto photo_hash = hash_of_file(task.photo.path);
    const auto parameters = recorded_parameters(image->spec(), task.photo.path);
    if (!photo_hash || !parameters)
        return photo_hash ? parameters.error() : photo_hash.error();
    if (const Status placed = place(*bytes, hash, path, may_replace); !placed)
        return placed.error();
    const auto parameters_json = parse_json<ordered_json>(to_json(*parameters, -1));
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return ordered_json{ { "output", task.output },
                         { "bytes", bytes->size() },
                         { "output_hash", hash },
                         { "settings", settings },
                         { "photo", task.photo.name },
                         { "photo_path", task.photo.path },
                         { "photo_hash", *photo_hash },
                         { "reference", task.reference },
                         { "reference_hash", parameters->reference_hash },
                         { "copy", task.copy },
                         { "seed", task.seed },
                         { "model_hash", parameters->model_hash },
                         { "parameters", parameters_json ? *parameters_json : ordered_json() },
                         { "width", image->spec().width },
                         { "height", image->spec().height },
                         { "channels", image->spec().nchannels },
                         { "time", std::int64_t(std::time(nullptr)) },
                         { "ms", std::int64_t(ms + 0.5) } };
}

} // namespace srisp::tool
