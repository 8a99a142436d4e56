// SPDX-License-Identifier: Apache-2.0
#include "batch_plan.h"

#include <filesystem>
#include <map>

#include "../common/failure.h"
#include "base/hashes.h"

namespace srisp::tool {

namespace {

bool is_in_shard(const Photo& photo, const Shard& shard)
{
    return shard.count < 2 || seeded_hash(0, photo.name) % shard.count == shard.index;
}

std::string output_name(const Photo& photo, int copy, std::size_t copies, const BatchOptions& options)
{
    std::filesystem::path name(photo.name);
    name.replace_extension();
    return name.string() + (copies > 1 ? "_" + std::to_string(copy) : "") + "." + format_name(options.format);
}

} // namespace

std::vector<BatchTask> plan_batch(const std::vector<Photo>& photos, const ReferenceSet& references,
                                  const BatchOptions& options)
{
    std::vector<BatchTask> tasks;
    std::map<std::string, std::string> photo_of_output;
    for (std::size_t place = 0; place < photos.size(); ++place) {
        const Photo& photo = photos[place];
        const std::vector<std::string> chosen = references.of(photo, place, options);
        for (std::size_t copy = 0; copy < chosen.size(); ++copy) {
            BatchTask task{ photo, int(copy), chosen[copy], 0, output_name(photo, int(copy), chosen.size(), options) };
            const auto [same, is_new] = photo_of_output.emplace(task.output, photo.name);
            if (!is_new)
                fail_usage("photos '" + same->second + "' and '" + photo.name + "' would both become '" + task.output +
                           "'");
            task.seed = seeded_hash(options.seed, photo.name + "\n" + std::to_string(copy));
            if (is_in_shard(photo, options.shard))
                tasks.push_back(std::move(task));
        }
    }
    return tasks;
}

} // namespace srisp::tool
