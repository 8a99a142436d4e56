// SPDX-License-Identifier: Apache-2.0
#include "image_task.h"

#include <chrono>
#include <filesystem>

#include <srisp/srisp.h>

#include "base/hashes.h"
#include "base/json_text.h"
#include "base/output_file.h"
#include "npy_file.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

Status save(const Image& image, const std::string& path, const BatchOptions& options)
{
    if (options.format == OutputFormat::npy)
        return write_output_file(path, npy_bytes(image, options.depth));
    static const OIIO::TypeDesc kStored[] = { OIIO::TypeHalf, OIIO::TypeFloat, OIIO::TypeUInt16 };
    return image.save(path, kStored[int(options.depth)]);
}

/// What a failed write says: without the trial's name, and with the reason that some writers do not tell.
Error write_error(const std::string& path, const std::string& message)
{
    constexpr std::uintmax_t kFull = 64 * 1024; // bytes
    const char kHow[] = "cannot be ";
    const std::size_t colon = message.find(": ", std::min(message.find(kHow), message.size()));
    std::string reason = colon == std::string::npos ? message : message.substr(colon + 2);
    std::error_code error;
    const fs::space_info space = fs::space(fs::path(path).parent_path(), error);
    if (!error && space.available < kFull)
        reason = kDiskFull;
    return { "output '" + path + "' cannot be written: " + reason };
}

/// Under a hidden name in the same folder, so that what is there can be compared before it is replaced.
std::string trial_name(const fs::path& path)
{
    return (path.parent_path() / (".srispbatch-" + path.filename().string())).string();
}

/// Puts a file in its place, or drops it where that has the same bytes.
Status place(const std::string& made, const std::string& hash, const std::string& path, bool may_replace)
{
    std::error_code error;
    if (!may_replace && fs::exists(path, error)) {
        const auto there = hash_of_file(path);
        if (!there)
            return there.error();
        if (*there != hash)
            return Error{ "output '" + path + "' exists, and srispbatch did not make it so; --overwrite replaces it" };
        fs::remove(made, error);
        return {};
    }
    fs::rename(made, path, error);
    return error ? Status(Error{ "output '" + path + "' cannot be created: " + error.message() }) : Status();
}

} // namespace

Expected<ordered_json> run_task(const BatchTask& task, const BatchOptions& options, const std::string& settings,
                                bool known, const InputFiles& inputs)
{
    const fs::path path = fs::path(options.output) / task.output;
    InputFiles photo;
    photo.add("photo", task.photo.path);
    for (const InputFiles* each : { &inputs, static_cast<const InputFiles*>(&photo) })
        if (const Status free = each->check_output(path.string()); !free)
            return free.error();
    const auto start = std::chrono::steady_clock::now();
    Options image_options = options.image;
    image_options.seed = image_options.noise_seed = task.seed;
    const auto image = unprocess(task.photo.path, task.reference, image_options);
    if (!image)
        return image.error();
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error)
        return Error{ "folder '" + path.parent_path().string() + "' cannot be made: " + error.message() };
    const std::string trial = trial_name(path);
    Status done = save(*image, trial, options);
    if (!done)
        done = write_error(path.string(), done.error().message);
    auto hash = done ? hash_of_file(trial) : Expected<std::string>(done.error());
    const std::uint64_t bytes = hash ? fs::file_size(trial, error) : 0;
    if (hash)
        done = place(trial, *hash, path.string(), options.overwrite || known);
    if (!hash || !done) {
        fs::remove(trial, error);
        return hash ? done.error() : hash.error();
    }
    const auto photo_hash = hash_of_file(task.photo.path);
    const auto parameters = recorded_parameters(image->spec(), task.photo.path);
    if (!photo_hash || !parameters)
        return photo_hash ? parameters.error() : photo_hash.error();
    const auto parameters_json = parse_json<ordered_json>(to_json(*parameters, -1));
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return ordered_json{ { "output", task.output },
                         { "photo", task.photo.name },
                         { "photo_path", task.photo.path },
                         { "photo_hash", *photo_hash },
                         { "reference", task.reference },
                         { "reference_hash", parameters->reference_hash },
                         { "copy", task.copy },
                         { "seed", task.seed },
                         { "settings", settings },
                         { "model_hash", parameters->model_hash },
                         { "parameters", parameters_json ? *parameters_json : ordered_json() },
                         { "width", image->spec().width },
                         { "height", image->spec().height },
                         { "channels", image->spec().nchannels },
                         { "bytes", bytes },
                         { "output_hash", *hash },
                         { "ms", std::int64_t(ms + 0.5) } };
}

} // namespace srisp::tool
