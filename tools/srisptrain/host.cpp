// SPDX-License-Identifier: Apache-2.0
#include "host.h"

#include <cstdio>
#include <ctime>
#include <map>
#include <set>

#include "../common/failure.h"
#include "base/printed.h"
#include "srisp_commit.h"
#include "train/run/model_file.h"

namespace srisp::tool {

using namespace train;

namespace {

/// "120/2400, 1.9/s, loss 0.043 (reverse 0.031, forward 0.012), 33.2 dB, 6.1 deg, 20 min left"
std::string progress_text(const RunProgress& progress)
{
    std::string text = std::to_string(progress.step) + "/" + std::to_string(progress.steps) + ", " +
                       printed("%.*f/s", progress.steps_per_second < 10 ? 2 : 0, progress.steps_per_second) +
                       ", loss " + printed("%.4f", progress.report.loss);
    std::string terms;
    for (const auto& [name, value] : progress.report.terms)
        terms += (terms.empty() ? " (" : ", ") + name + " " + printed("%.4f", value);
    text += terms.empty() ? "" : terms + ")";
    if (progress.last_validation)
        text += ", " + printed("%.2f dB, ", progress.last_validation->psnr) +
                printed("%.2f deg", progress.last_validation->angle);
    return text + ", " + duration_text(progress.seconds_left) + " left";
}

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

/// What a model file says of how it came about: train_data and license (open images only: the recipe's; else that it
/// may not be given away), train_commit, date.
std::map<std::string, std::string> model_metadata(const TrainingRecipe& recipe, const TrainingPack& pack)
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

} // namespace

void Host::progress(const RunProgress& progress)
{
    m_line.show([&] { return progress_text(progress); });
}

void Host::note(const std::string& line)
{
    m_line.wipe();
    std::fprintf(stderr, "srisptrain: %s\n", line.c_str());
}

std::optional<Validation> Host::validate(Unprocessor& model, const StillThere& still_there)
{
    if (!m_session.tests)
        return {};
    return validation_of(evaluate(model, *m_session.tests, [&](int) { require(still_there()); }),
                         m_session.settings().validation.score);
}

Status Host::save_model(Unprocessor& model, const std::string& path, const std::optional<Validation>& result,
                        std::int64_t step)
{
    const TrainingRecipe& recipe = m_session.settings();
    std::map<std::string, std::string> metadata = model_metadata(recipe, *m_session.pack);
    nlohmann::ordered_json metrics = { { "recipe", m_session.recipe.name }, { "seed", recipe.seed }, { "step", step } };
    if (result) {
        metrics["psnr"] = result->psnr;
        metrics["angle"] = result->angle;
        metrics["validation"] = result->details;
    }
    metadata["metrics"] = metrics.dump();
    return train::save_model(model, recipe.model, path, metadata, recipe.precision,
                             result ? result->deviation_factor : 1);
}

} // namespace srisp::tool
