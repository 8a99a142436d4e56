// SPDX-License-Identifier: Apache-2.0
#include "shot_parameters.h"

#include <memory>

#include <srisp/srisp.h>

#include "base/recently_kept.h"

namespace srisp::tool {

namespace {

using Kept = std::shared_ptr<const Parameters>;

/// As the result records them.
Expected<Kept> chosen(const ListedFile& first, const std::string& reference, std::uint64_t seed, Options options)
{
    options.seed = seed;
    options.mosaic.reset();
    options.noise.clear();
    options.develop.clear();
    const auto image = unprocess(first.path, reference, options);
    if (!image)
        return image.error();
    auto parameters = recorded_parameters(image->spec(), "photo '" + first.path + "'");
    if (!parameters)
        return parameters.error();
    return std::make_shared<const Parameters>(std::move(*parameters));
}

} // namespace

Expected<Parameters> shot_parameters(const ListedFile& first, const std::string& reference, std::uint64_t seed,
                                     const Options& options)
{
    constexpr std::size_t kMostShots = 64;
    static RecentlyKept<Kept> kept(kMostShots);
    const auto found = kept.get(first.path + "\n" + reference + "\n" + std::to_string(seed),
                                [&] { return chosen(first, reference, seed, options); });
    if (!found)
        return Error{ "the shot's first photo: " + found.error().message };
    return **found;
}

} // namespace srisp::tool
