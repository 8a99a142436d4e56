// SPDX-License-Identifier: Apache-2.0
#include "pack_run.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <srisp/image.h>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "base/guarded.h"
#include "base/input_files.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "camera_folder.h"
#include "inputs.h"
#include "linear_set.h"
#include "pack/training_pack_index.h"
#include "pack/training_pack_writer.h"
#include "pack_tasks.h"
#include "summary.h"

namespace srisp::tool {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kBatchBytes = 128u << 20;
constexpr std::size_t kLargestBatch = 64;
constexpr std::size_t kListedFailures = 20;

/// Counts what is done over all parts.
struct Progress {
    ProgressMeter& meter;
    std::int64_t done = 0;
};

std::size_t batch_size(const CropSettings& settings)
{
    const std::size_t scene =
        std::size_t(settings.crops + 1) * 3 * sizeof(std::uint16_t) * settings.size * settings.size;
    return std::clamp<std::size_t>(kBatchBytes / scene, 2, kLargestBatch);
}

Expected<PackedScene> run_task(const PackTask& task)
{
    if (pending_interrupt())
        return Error{ "interrupted" };
    try {
        return task.run();
    } catch (const std::exception& error) {
        return Error{ "'" + task.name + "': " + thrown_text(error) };
    }
}

std::vector<Expected<PackedScene>> run_batch(const std::vector<PackTask>& tasks, std::size_t first, std::size_t count,
                                             int threads)
{
    std::vector<Expected<PackedScene>> results(count, PackedScene());
    parallel_tasks(static_cast<std::int64_t>(count), threads,
                   [&](std::int64_t i) { results[std::size_t(i)] = run_task(tasks[first + std::size_t(i)]); });
    check_interrupt();
    return results;
}

void count(const PackedScene& packed, PartReport& report)
{
    const PackEntry& image = packed.scene.common;
    ++report.scenes;
    report.images += int(packed.scene.crops.size());
    report.open += image.open;
    report.validation += image.validation;
    report.enlarged += packed.enlarged;
    ++report.licences[image.licence];
    ++report.groups[image.group];
}

/// Runs the tasks on all threads and writes their images in the order of the tasks, a batch at a time: memory does not
/// grow with their number. Throws Interrupted; fails when the disk does.
PartReport pack_images(const std::vector<PackTask>& tasks, PackImagesWriter& writer, const CropSettings& settings,
                       int threads, Progress& progress)
{
    PartReport report;
    report.size = settings.size;
    for (std::size_t first = 0; first < tasks.size(); first += batch_size(settings)) {
        const std::size_t batch = std::min(batch_size(settings), tasks.size() - first);
        for (const Expected<PackedScene>& packed : run_batch(tasks, first, batch, threads)) {
            if (!packed) {
                report.failures.push_back(packed.error().message);
            } else if (!packed->left_out.empty()) {
                ++report.left_out[packed->left_out];
            } else {
                if (const Status status = writer.add(packed->scene, packed->pixels); !status)
                    fail(status.error().message);
                count(*packed, report);
            }
        }
        progress.meter.show(progress.done += std::int64_t(batch));
    }
    return report;
}

/// Where there are only sets, their own size: enlarging adds nothing.
int choose_raw_size(const PackOptions& options, const Inputs& inputs)
{
    if (options.raw_size > 0)
        return options.raw_size;
    const int size = std::min(options.size, kThumbnailSize);
    int largest_set = 0;
    for (const ImageInput& set : inputs.sets)
        largest_set = std::max(largest_set, linear_set_size(set.path));
    return inputs.raws.empty() && largest_set > 0 ? std::min(size, largest_set) : size;
}

std::vector<PackTask> photo_tasks(const Inputs& inputs, const CropSettings& settings)
{
    std::vector<PackTask> tasks;
    for (const ImageInput& photo : inputs.photos)
        tasks.push_back(photo_task(photo.path, photo.name, photo.provenance, settings));
    return tasks;
}

std::vector<PackTask> raw_tasks(const Inputs& inputs, const CropSettings& settings)
{
    std::vector<PackTask> tasks;
    for (const ImageInput& raw : inputs.raws)
        tasks.push_back(raw_task(raw.path, raw.name, raw.provenance, settings));
    for (const ImageInput& set : inputs.sets)
        for (PackTask& task : linear_set_tasks(set.path, set.name, set.provenance, settings))
            tasks.push_back(std::move(task));
    return tasks;
}

/// Lists what cannot be read; fails if that is not allowed, or if nothing else was there.
void judge(const PartReport& report, const char* what, bool strict, ProgressMeter& meter)
{
    meter.wipe();
    const std::size_t failed = report.failures.size();
    for (std::size_t i = 0; i < std::min(failed, kListedFailures); ++i)
        std::fprintf(stderr, "srisppack: %s\n", report.failures[i].c_str());
    if (failed > kListedFailures)
        std::fprintf(stderr, "srisppack: ... and %zu more\n", failed - kListedFailures);
    if (failed > 0 && strict)
        fail(std::to_string(failed) + " " + what + " cannot be read (--strict)");
    if (report.scenes == 0)
        fail(std::string("none of the ") + what + " can be used");
    if (failed > 0)
        std::fprintf(stderr, "srisppack: %zu %s cannot be read and are left out\n", failed, what);
}

/// An old pack that is to be replaced may hold a set that is to be packed.
void refuse_inputs_as_outputs(const PackOptions& options, const Inputs& inputs)
{
    InputFiles files;
    for (const auto* images : { &inputs.photos, &inputs.raws, &inputs.sets })
        for (const ImageInput& image : *images)
            files.add("input", image.path);
    std::error_code error;
    for (fs::directory_iterator entry(options.output, error), end; !error && entry != end; entry.increment(error))
        require(files.check_output(entry->path().string()));
}

nlohmann::json settings_of(const PackOptions& options, int raw_size)
{
    return { { "size", options.size },
             { "raw_size", raw_size },
             { "crops", options.crops },
             { "seed", options.seed },
             { "open_only", options.open_only } };
}

} // namespace

Summary make_pack(const PackOptions& options)
{
    const Inputs inputs = find_inputs(options);
    auto created = TrainingPackWriter::create(options.output, options.replace);
    if (!created)
        fail("output " + created.error().message);
    refuse_inputs_as_outputs(options, inputs);
    TrainingPackWriter& pack = **created;

    const CropSettings photo_settings{ options.size, options.crops, options.seed };
    const CropSettings raw_settings{ choose_raw_size(options, inputs), options.crops, options.seed };
    const std::vector<PackTask> photos = photo_tasks(inputs, photo_settings), raws = raw_tasks(inputs, raw_settings);
    ProgressMeter meter({ "srisppack", "images", std::int64_t(photos.size() + raws.size()) }, !options.quiet);
    Progress progress{ meter };

    Summary summary{ options.output, {}, {}, {}, inputs.not_in_manifest, inputs.not_open, inputs.other_files };
    // Quick to read, so that errors in it come first.
    if (!inputs.cameras.empty()) {
        const CameraFolder cameras = read_camera_folder(inputs.cameras);
        require(pack.add_cameras(cameras.spectra, cameras.names));
        summary.cameras = cameras.names;
    }
    if (!photos.empty()) {
        PackImagesWriter writer(pack.photos_path(), photo_settings.size);
        summary.photos = pack_images(photos, writer, photo_settings, options.threads, progress);
        judge(*summary.photos, "photos", options.strict, meter);
        require(pack.add_photos(writer));
    }
    if (!raws.empty()) {
        PackImagesWriter writer(pack.raws_path(), raw_settings.size);
        summary.raws = pack_images(raws, writer, raw_settings, options.threads, progress);
        judge(*summary.raws, "RAW images", options.strict, meter);
        require(pack.add_raws(writer));
    }
    check_interrupt();
    require(pack.finish("srisppack " SRISP_VERSION, settings_of(options, raw_settings.size)));
    return summary;
}

} // namespace srisp::tool
