// SPDX-License-Identifier: Apache-2.0
#include <srisp/reference.h>

#include "base/guarded.h"
#include "base/recently_kept.h"
#include "reference/sample_layout.h"

namespace srisp {

std::string reference_state(const std::string& path)
{
    std::string state = file_state(path);
    for (const std::string& layout : layout_paths(path))
        state += "\n" + file_state(layout);
    return state;
}

Expected<std::shared_ptr<const Reference>> load_reference_cached(const std::string& path)
{
    constexpr std::size_t kMostKept = 64; // 0.8 MB each
    // Never destroyed: other threads of the host may still read while statics end.
    static auto& kept = *new RecentlyKept<std::shared_ptr<const Reference>>(kMostKept);
    return guarded("reference", path,
                   [&] { return kept.get(reference_state(path), [&] { return load_reference(path); }); });
}

} // namespace srisp
