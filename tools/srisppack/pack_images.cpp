// SPDX-License-Identifier: Apache-2.0
#include "pack_images.h"

#include <algorithm>
#include <exception>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "base/parallel.h"

namespace srisp::tool {

namespace {

constexpr std::size_t kBatchBytes = 128u << 20;
constexpr std::size_t kLargestBatch = 64;

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
        return Error{ "'" + task.name + "': " + error.what() };
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

} // namespace

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

} // namespace srisp::tool
