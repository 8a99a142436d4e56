// SPDX-License-Identifier: Apache-2.0
#include "reference/reference_cache.h"

#include "base/guarded.h"
#include "base/recently_kept.h"
#include "recipe/reference_pattern.h"

namespace srisp {

std::vector<std::string> reference_files(const std::string& path)
{
    std::vector<std::string> files = layout_paths(path);
    files.insert(files.begin(), path);
    return files;
}

std::string reference_state(const std::string& path)
{
    std::string state;
    for (const std::string& file : reference_files(path))
        state += (state.empty() ? "" : "\n") + file_state(file);
    return state;
}

static RecentlyKept<std::shared_ptr<const Reference>>& kept_references()
{
    constexpr std::size_t kMostKept = 64; // 0.8 MB each
    // Never destroyed: other threads of the host may still read while statics end.
    static auto& kept = *new RecentlyKept<std::shared_ptr<const Reference>>(kMostKept);
    return kept;
}

void set_most_kept_references(std::size_t most)
{
    kept_references().set_most(most);
}

bool is_reference_kept(const std::string& path)
{
    return kept_references().find(reference_state(path)) != nullptr;
}

void keep_reference(const std::shared_ptr<const Reference>& reference)
{
    kept_references().keep(reference_state(reference->path), reference);
}

Expected<std::shared_ptr<const Reference>> load_reference_cached(const std::string& path, bool isolate)
{
    return guarded("reference", path, [&] {
        return kept_references().get(reference_state(path), [&] { return load_reference(path, isolate); });
    });
}

} // namespace srisp
