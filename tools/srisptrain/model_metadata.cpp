// SPDX-License-Identifier: Apache-2.0
#include "model_metadata.h"

#include <ctime>
#include <set>

#include "srisp_commit.h"

namespace srisp::tool {

using namespace train;

namespace {

/// The images of one source.
struct Source {
    std::set<int> scenes;
    bool open = true;
};

/// By "group (licence)".
std::map<std::string, Source> sources_of(const PackedImages& images, bool open_only)
{
    std::map<std::string, Source> sources;
    for (const PackEntry& entry : images.entries) {
        if (entry.validation || (open_only && !entry.open))
            continue;
        Source& source = sources[entry.group + " (" + entry.licence + ")"];
        source.scenes.insert(entry.scene);
        source.open = source.open && entry.open;
    }
    return sources;
}

std::string sources_text(const std::map<std::string, Source>& sources, const std::string& kind)
{
    std::string text;
    for (const auto& [name, source] : sources)
        text += (text.empty() ? "" : ", ") + std::to_string(source.scenes.size()) + " " + name;
    return text.empty() ? "" : kind + ": " + text + "; ";
}

std::string today()
{
    const std::time_t now = std::time(nullptr);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
    return text;
}

} // namespace

std::map<std::string, std::string> model_metadata(const Recipe& recipe, const TrainingPack& pack)
{
    const auto photos = sources_of(pack.photos(), recipe.data.open_only);
    const auto raws =
        recipe.data.raw_share > 0 ? sources_of(pack.raws(), recipe.data.open_only) : std::map<std::string, Source>();
    bool open = true;
    for (const auto& sources : { photos, raws })
        for (const auto& item : sources)
            open = open && item.second.open;
    std::map<std::string, std::string> metadata = {
        { "train_data", sources_text(photos, "photos") + sources_text(raws, "RAW images") +
                            std::to_string(pack.cameras().names.size()) + " simulated cameras; pack " + pack.hash() },
        { "license", open ? recipe.licence : "not to be given away: trained on images that are not open" },
        { "date", today() },
    };
    if (*kSourceCommit)
        metadata["train_commit"] = kSourceCommit;
    return metadata;
}

} // namespace srisp::tool
