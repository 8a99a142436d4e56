// SPDX-License-Identifier: Apache-2.0
#include "finished_set.h"

#include <cstdio>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

#include <srisp/reference.h>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "../common/machine_share.h"
#include "base/hashes.h"
#include "base/input_files.h"
#include "base/json_text.h"
#include "base/parsed_number.h"
#include "base/progress.h"
#include "image_task.h"
#include "manifest.h"
#include "settings.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Where a line of a manifest stands, and the folder whose results it records.
struct Record {
    ordered_json line;
    std::string output;
};

/// The folder above a result that has a manifest.
std::string folder_of_result(const fs::path& result)
{
    std::error_code error;
    for (fs::path folder = fs::absolute(result).lexically_normal().parent_path();; folder = folder.parent_path()) {
        if (fs::is_directory(manifest_folder(folder.string()), error))
            return folder.string();
        if (folder == folder.parent_path())
            fail("'" + result.string() + "' lies in no folder with a manifest of srispbatch's");
    }
}

/// From "FOLDER/manifest/all.jsonl:17"; none: it is no such text.
std::optional<std::pair<std::string, std::size_t>> line_place(const std::string& text)
{
    const std::size_t colon = text.rfind(".jsonl:");
    if (colon == std::string::npos)
        return {};
    const std::size_t digits = colon + 7;
    const auto number = parsed_number<std::size_t>(std::string_view(text).substr(digits));
    if (!number || *number == 0)
        return {};
    return std::make_pair(text.substr(0, digits - 1), *number);
}

Record find_record(const std::string& text)
{
    Record found;
    if (const auto place = line_place(text)) {
        const fs::path file = fs::absolute(place->first).lexically_normal();
        found.output = file.parent_path().parent_path().string();
        for_each_record(found.output, [&](const ordered_json& line, const std::string& name, std::size_t number) {
            if (number == place->second && fs::path(name).filename() == file.filename())
                found.line = line;
        });
    } else {
        found.output = folder_of_result(text);
        const std::string name = fs::absolute(text).lexically_normal().lexically_relative(found.output).string();
        for_each_record(found.output, [&](const ordered_json& line, const std::string&, std::size_t) {
            if (line.at("output") == name &&
                (found.line.is_null() || number_of(line, "time") >= number_of(found.line, "time")))
                found.line = line;
        });
    }
    if (found.line.is_null())
        fail("'" + text + "' is not in the manifest");
    return found;
}

BatchTask task_of(const ordered_json& line)
{
    BatchTask task;
    try {
        task.photo = { line.at("photo_path").get<std::string>(), line.at("photo").get<std::string>() };
        task.copy = line.at("copy").get<int>();
        task.reference = line.at("reference").get<std::string>();
        task.seed = line.at("seed").get<std::uint64_t>();
        task.output = line.at("output").get<std::string>();
        task.parameters = std::make_shared<const Parameters>(
            require(parameters_from_json(line.at("parameters").dump(), "'" + task.output + "'")));
    } catch (const ordered_json::exception& error) {
        fail(std::string("its line in the manifest cannot be read: ") + error.what());
    }
    return task;
}

} // namespace

std::int64_t verify_set(const BatchOptions& options)
{
    const std::string& folder = options.photos[0];
    const Manifest manifest(folder, "all");
    if (manifest.entries().empty())
        fail("folder '" + folder + "' has no manifest of srispbatch's");
    std::int64_t wrong = 0, compared = 0;
    ProgressMeter meter({ "srispbatch", "results compared", std::int64_t(manifest.entries().size()) }, !options.quiet);
    const auto tell = [&](const std::string& name, const char* what) {
        ++wrong;
        meter.wipe();
        std::fprintf(stderr, "srispbatch: '%s' %s\n", (fs::path(folder) / name).c_str(), what);
    };
    for (const std::string& name : read_plan(folder))
        if (manifest.entries().count(name) == 0)
            tell(name, "was planned, and is not made");
    std::mutex mutex; // of all that follows
    auto next = manifest.entries().begin();
    const auto work = [&] {
        std::unique_lock lock(mutex);
        while (next != manifest.entries().end() && !pending_interrupt()) {
            const auto& [name, entry] = *next++;
            lock.unlock();
            const auto hash = hash_of_file((fs::path(folder) / name).string());
            lock.lock();
            if (!hash)
                tell(name, "is missing or cannot be read");
            else if (*hash != entry.hash)
                tell(name, "has not the bytes that the manifest names");
            meter.show(++compared);
        }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < images_at_a_time(options.threads); ++i)
        threads.emplace_back(work);
    for (std::thread& thread : threads)
        thread.join();
    check_interrupt();
    meter.wipe();
    if (options.json)
        std::printf("{\"event\": \"verified\", \"results\": %lld, \"failed\": %lld}\n", (long long)compared,
                    (long long)wrong);
    else if (!options.quiet)
        std::printf("%lld results compared, %lld missing or not as they were made\n", (long long)compared,
                    (long long)wrong);
    return wrong;
}

void redo_result(const BatchOptions& options)
{
    const Record record = find_record(options.redo);
    const BatchTask task = task_of(record.line);
    const std::string path = options.output.empty() ? (fs::path(record.output) / task.output).string() : options.output;
    InputFiles inputs;
    inputs.add("photo", task.photo.path);
    inputs.add("reference", task.reference);
    require(inputs.check_output(path));
    if (require(hash_of_file(task.photo.path)) != text_of(record.line, "photo_hash"))
        fail("photo '" + task.photo.path + "' has changed since");
    if (require(load_reference_cached(task.reference))->hash != text_of(record.line, "reference_hash"))
        fail("reference '" + task.reference + "' has changed since");
    const std::string settings = text_of(record.line, "settings");
    const MakingOptions making = options_of_settings(read_settings(record.output, settings));
    prepare_making(making.format, 1);
    const auto line = require(run_task(task, path, making, settings, true, [](std::uint64_t) {}));
    if (line["output_hash"] != text_of(record.line, "output_hash"))
        fail("'" + path + "' is made again, but its bytes are not those that are recorded: another version made them");
    if (!options.quiet)
        std::printf("'%s' is made again, to the bit\n", path.c_str());
}

} // namespace srisp::tool
