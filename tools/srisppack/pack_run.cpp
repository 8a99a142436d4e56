// SPDX-License-Identifier: Apache-2.0
#include "pack_run.h"

#include <algorithm>
#include <cstdio>

#include <srisp/image.h>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "../common/require.h"
#include "camera_folder.h"
#include "linear_set.h"
#include "photo_task.h"
#include "raw_task.h"

namespace srisp::tool {

namespace {

constexpr std::size_t kListedFailures = 20;

/// Where there are only sets, their own size: enlarging adds nothing.
int choose_raw_size(const Options& options, const Inputs& inputs)
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

nlohmann::json settings_of(const Options& options, int raw_size)
{
    return { { "size", options.size },
             { "raw_size", raw_size },
             { "crops", options.crops },
             { "seed", options.seed },
             { "open_only", options.open_only } };
}

} // namespace

Summary make_pack(const Options& options)
{
    const Inputs inputs = find_inputs(options);
    auto created = TrainingPackWriter::create(options.output, options.replace);
    if (!created)
        fail("output " + created.error().message);
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
