// SPDX-License-Identifier: Apache-2.0
#include "batch_plan.h"

#include <filesystem>
#include <unordered_map>

#include "../common/failure.h"
#include "base/hashes.h"
#include "shards.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;

/// Photos that belong together: one, or the frames of a shot. Places in the list of photos.
using Group = std::vector<std::size_t>;

std::vector<Group> groups_of(const std::vector<ListedFile>& photos, bool hold)
{
    std::vector<Group> groups;
    std::unordered_map<std::string, std::size_t> of_folder;
    for (std::size_t place = 0; place < photos.size(); ++place) {
        const std::string key = hold ? fs::path(photos[place].name).parent_path().string() : "";
        const auto [found, is_new] = of_folder.emplace(key, groups.size());
        if (is_new || !hold)
            groups.emplace_back();
        groups[hold ? found->second : groups.size() - 1].push_back(place);
    }
    return groups;
}

/// By the sizes of files, unless all shards together would look at too many of them: a file system that many machines
/// share answers some ten thousand such questions a second. Then there are so many photos that their numbers do as
/// well.
std::vector<std::uint64_t> shards_of(const std::vector<Group>& groups, const std::vector<ListedFile>& photos,
                                     std::uint64_t count)
{
    constexpr std::uint64_t kMostLooks = 5'000'000;
    const bool looks = count > 1 && photos.size() <= kMostLooks / count;
    std::vector<ShardItem> items;
    for (const Group& group : groups) {
        items.push_back({ photos[group[0]].name, 0 });
        for (const std::size_t place : group) {
            std::error_code error; // one that is missing takes no time
            const std::uintmax_t bytes = looks ? fs::file_size(photos[place].path, error) : 1;
            items.back().bytes += error ? 0 : bytes;
        }
    }
    return assign_shards(items, count);
}

std::string output_name(const ListedFile& photo, std::size_t copy, std::size_t copies, const BatchOptions& options)
{
    fs::path name(photo.name);
    name.replace_extension();
    return name.string() + (copies > 1 ? "_" + std::to_string(copy) : "") + "." + format_name(options.format);
}

std::uint64_t seed_of(const ListedFile& photo, std::size_t copy, const BatchOptions& options)
{
    return seeded_hash(options.seed, photo.name + "\n" + std::to_string(copy));
}

} // namespace

BatchPlan plan_batch(const std::vector<ListedFile>& photos, const ReferenceSet& references, const BatchOptions& options)
{
    BatchPlan plan;
    std::unordered_map<std::string, const std::string*> photo_of_output;
    const std::vector<Group> groups = groups_of(photos, options.hold);
    const std::vector<std::uint64_t> shards = shards_of(groups, photos, options.shard.count);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const std::size_t first = groups[g][0];
        const std::vector<std::string> chosen = references.of(photos[first], first, options);
        for (const std::size_t place : groups[g])
            for (std::size_t copy = 0; copy < chosen.size(); ++copy) {
                const ListedFile& photo = photos[place];
                BatchTask task;
                task.output = output_name(photo, copy, chosen.size(), options);
                const auto [same, is_new] = photo_of_output.emplace(task.output, &photo.name);
                if (!is_new)
                    fail_usage("photos '" + *same->second + "' and '" + photo.name + "' would both become '" +
                               task.output + "'");
                plan.outputs.push_back(task.output);
                if (shards[g] != options.shard.index)
                    continue;
                task.photo = photo;
                task.copy = int(copy);
                task.reference = chosen[copy];
                task.seed = seed_of(photo, copy, options);
                if (options.hold) {
                    task.shot = photos[first];
                    task.shot_seed = seed_of(photos[first], copy, options);
                }
                plan.tasks.push_back(std::move(task));
            }
    }
    return plan;
}

} // namespace srisp::tool
