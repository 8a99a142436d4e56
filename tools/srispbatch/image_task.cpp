// SPDX-License-Identifier: Apache-2.0
#include "image_task.h"

#include <malloc.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <optional>

#include <srisp/srisp.h>

#include "../common/own_location.h"
#include "base/hashes.h"
#include "base/json_text.h"
#include "base/output_file.h"
#include "container/image_memory.h"
#include "npy_file.h"
#include "photo/pixel_source.h"
#include "reference/reference_cache.h"
#include "result/file_encoder.h"
#include "shot_parameters.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// A photo's picture by its header.
Expected<OIIO::ImageSpec> picture_of(const std::string& photo, const Options& options)
{
    const auto source = open_source(photo, "photo", reading_hints(options));
    if (!source)
        return source.error();
    const auto spec = (*source)->find_level(0, 0);
    return spec ? Expected<OIIO::ImageSpec>(*spec) : Error{ (*source)->name() + ": has no picture" };
}

/// Waits for the memory that making an image takes at most. Errors: the photo's own.
Status ask_for_memory(const std::string& photo, const Options& options, const AskForMemory& ask)
{
    const auto spec = picture_of(photo, options);
    if (!spec)
        return spec.error();
    const bool resized = !options.resize.empty() || !options.crop.empty();
    const std::uint64_t pixels = std::uint64_t(spec->image_pixels());
    const int channels = std::max(spec->nchannels, 3);
    ask(image_memory(resized ? 2 * pixels : pixels, channels)); // and floats of the whole
    return {};
}

/// A result as the bytes of its file, and what it says of itself.
struct Encoded {
    OIIO::ImageSpec spec;
    std::vector<unsigned char> bytes;
};

Expected<Encoded> encode_npy(const BatchTask& task, const Options& image, OutputDepth depth)
{
    Encoded made;
    std::optional<NpyEncoder> encoder;
    ImageSink sink;
    sink.holds_all = true;
    sink.begin = [&](const OIIO::ImageSpec& spec) -> Status {
        made.spec = spec;
        encoder.emplace(spec, depth);
        return {};
    };
    sink.rows = [&](const float* rows, int count) -> Status {
        encoder->add_rows(rows, count);
        return {};
    };
    if (const Status done = unprocess(task.photo.path, task.reference, image, sink); !done)
        return done.error();
    made.bytes = encoder->take();
    return made;
}

Expected<Encoded> encode_image(const BatchTask& task, const Options& image, const std::string& path,
                               const MakingOptions& options)
{
    static const OIIO::TypeDesc kStored[] = { OIIO::TypeHalf, OIIO::TypeFloat, OIIO::TypeUInt16 };
    const auto error = [&](const Error& reason) {
        return Error{ "output '" + path + "' cannot be written: " + reason.message };
    };
    auto encoder = FileEncoder::create(path);
    if (!encoder)
        return error(encoder.error());
    Encoded made;
    bool by_writer = false; // an error is the writer's, not the photo's
    ImageSink sink;
    sink.holds_all = true;
    sink.begin = [&](const OIIO::ImageSpec& spec) {
        made.spec = spec;
        const Status begun = encoder->begin(spec, kStored[int(options.depth)], options.compression);
        by_writer = !begun;
        return begun;
    };
    sink.rows = [&](const float* rows, int count) {
        const Status added = encoder->add_rows(rows, count);
        by_writer = !added;
        return added;
    };
    if (const Status done = unprocess(task.photo.path, task.reference, image, sink); !done)
        return by_writer ? error(done.error()) : done.error();
    auto bytes = encoder->finish();
    if (!bytes)
        return error(bytes.error());
    made.bytes = std::move(*bytes);
    return made;
}

/// What the library is asked for.
Expected<Options> options_for(const BatchTask& task, const MakingOptions& options)
{
    Options image = options.image;
    image.seed = image.noise_seed = task.seed;
    if (task.parameters) {
        image.parameters = *task.parameters;
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
Status place(const std::vector<unsigned char>& bytes, const std::string& hash, const std::string& path,
             bool may_replace)
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
    const Status written = write_output_file(path, bytes.data(), bytes.size());
    return written ? written : Status(Error{ "output " + written.error().message });
}

} // namespace

void prepare_making(OutputFormat format, std::size_t most_references)
{
    // Photos at a time fill the processor; each by itself has one thread.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1); // OpenEXR's own ones
    // Each image takes the memory that the one before it gave back: new pages cost as much as choosing parameters does.
    constexpr int kKept = 256 << 20, kOfTheHeap = 32 << 20; // bytes; the latter is glibc's limit
    ::mallopt(M_TRIM_THRESHOLD, kKept);
    ::mallopt(M_TOP_PAD, kOfTheHeap);
    ::mallopt(M_MMAP_THRESHOLD, kOfTheHeap);
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
    if (const Status fits = ask_for_memory(task.photo.path, options.image, ask); !fits)
        return fits.error();
    const auto start = std::chrono::steady_clock::now();
    const auto image_options = options_for(task, options);
    if (!image_options)
        return image_options.error();
    const auto made = options.format == OutputFormat::npy ? encode_npy(task, *image_options, options.depth)
                                                          : encode_image(task, *image_options, path, options);
    if (!made)
        return made.error();
    const std::string hash = hash_of_bytes(made->bytes.data(), made->bytes.size());
    const auto photo_hash = hash_of_file(task.photo.path);
    const auto parameters = recorded_parameters(made->spec, task.photo.path);
    if (!photo_hash || !parameters)
        return photo_hash ? parameters.error() : photo_hash.error();
    if (const Status placed = place(made->bytes, hash, path, may_replace); !placed)
        return placed.error();
    const auto parameters_json = parse_json<ordered_json>(to_json(*parameters, -1));
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return ordered_json{ { "output", task.output },
                         { "bytes", made->bytes.size() },
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
                         { "width", made->spec.width },
                         { "height", made->spec.height },
                         { "channels", made->spec.nchannels },
                         { "time", std::int64_t(std::time(nullptr)) },
                         { "ms", std::int64_t(ms + 0.5) } };
}

} // namespace srisp::tool
