// SPDX-License-Identifier: Apache-2.0
#include "result/chooser.h"

#include <filesystem>
#include <map>

#include <srisp/metadata.h>
#include <srisp/select.h>

#include "base/recently_kept.h"
#include "photo/photo_reader.h"

namespace srisp {

namespace {

constexpr std::size_t kMostChoices = 64;
constexpr std::size_t kMostModels = 8;

// Never destroyed: other threads of the host may still read while statics end.
RecentlyKept<ChoicePtr>& choices()
{
    static auto& kept = *new RecentlyKept<ChoicePtr>(kMostChoices);
    return kept;
}

/// By recipe and subimage: the first choice of a recipe that says `hold`.
RecentlyKept<ChoicePtr>& held_choices()
{
    static auto& kept = *new RecentlyKept<ChoicePtr>(1 << 20);
    return kept;
}

Expected<std::shared_ptr<const Model>> load_model_cached(const std::string& name)
{
    static auto& models = *new RecentlyKept<std::shared_ptr<const Model>>(kMostModels);
    static auto& paths = *new RecentlyKept<std::shared_ptr<const std::string>>(kMostModels);
    if (const auto path = paths.find(name))
        if (const auto model = models.find(file_state(*path)))
            return model;
    auto model = Model::load(name);
    if (!model)
        return model;
    paths.keep(name, std::make_shared<const std::string>((*model)->path()));
    return models.keep(file_state((*model)->path()), *model);
}

std::string held_key(const Recipe& recipe, int subimage)
{
    return recipe.path + "\n" + std::to_string(subimage);
}

} // namespace

Expected<Chooser> Chooser::create(const Recipe& recipe, const std::string& photo_name)
{
    Chooser chooser;
    chooser.m_recipe = recipe;
    if (!recipe.parameters.empty()) {
        auto given = parameters_from_json(recipe.parameters, recipe.parameters_where);
        if (!given)
            return given.error();
        chooser.m_given = *given;
    }
    std::string model = recipe.model;
    if (model.empty() && chooser.m_given)
        model = chooser.m_given->model_name;
    if (model.empty() && recipe.direction == Direction::reverse)
        model = "default";
    if (!model.empty()) {
        auto loaded = load_model_cached(model);
        if (!loaded)
            return loaded.error();
        chooser.m_model = *loaded;
    }
    if (chooser.m_given)
        if (const Status fits = check_parameters(*chooser.m_given, *chooser.m_model); !fits)
            return fits.error();
    if (!recipe.reference.empty() && recipe.direction == Direction::reverse) {
        auto reference = choose_reference(recipe.reference, recipe.seed, photo_name);
        if (!reference)
            return reference.error();
        chooser.m_reference = *reference;
        std::error_code ignored;
        if (!std::filesystem::exists(chooser.m_reference, ignored))
            return Error{ "reference '" + chooser.m_reference + "': No such file or directory" };
    }
    return chooser;
}

std::string Chooser::key(const PixelSource& source, int subimage) const
{
    return source.key() + "\n" + std::to_string(subimage) + "\n" + std::to_string(static_cast<int>(m_recipe.input)) +
           "\n" + m_model->hash() + "\n" + m_recipe.parameters + "\n" + file_state(m_reference);
}

Expected<ChoicePtr> Chooser::known(const PixelSource& source, int subimage, const OIIO::ImageSpec& stored) const
{
    if (m_recipe.direction == Direction::reverse) {
        if (m_given && m_reference.empty())
            return ChoicePtr(std::make_shared<Choice>(Choice{ m_model, *m_given, nullptr, {} }));
        const ChoicePtr held = m_recipe.hold ? held_choices().find(held_key(m_recipe, subimage)) : nullptr;
        return held ? held : choices().find(key(source, subimage));
    }
    if (!m_given && !is_unprocessed(stored))
        return Error{ source.name() + ": is no RAW-like image of srisp's, so it records no parameters; give params=" };
    auto parameters = m_given ? Expected<Parameters>(*m_given) : recorded_parameters(stored, source.name());
    if (!parameters)
        return parameters.error();
    auto model = m_model ? Expected<std::shared_ptr<const Model>>(m_model) : load_model_cached(parameters->model_name);
    if (!model)
        return model.error();
    if (const Status fits = check_parameters(*parameters, **model); !fits)
        return Error{ source.name() + ": " + fits.error().message };
    return ChoicePtr(std::make_shared<Choice>(Choice{ *model, *parameters, nullptr, {} }));
}

Expected<ChoicePtr> Chooser::choose(PixelSource& source, int subimage, const OIIO::ImageSpec& stored,
                                    const PhotoConverter& converter, int threads) const
{
    auto found = known(source, subimage, stored);
    if (!found || *found)
        return found;
    auto choice = select_new(source, subimage, stored, converter, threads);
    if (!choice)
        return choice;
    ChoicePtr kept = choices().keep(key(source, subimage), *choice);
    if (m_recipe.hold)
        kept = held_choices().keep(held_key(m_recipe, subimage), kept);
    return kept;
}

Expected<ChoicePtr> Chooser::select_new(PixelSource& source, int subimage, const OIIO::ImageSpec& stored,
                                        const PhotoConverter& converter, int threads) const
{
    auto reference = load_reference_cached(m_reference);
    if (!reference)
        return reference.error();
    auto choice = std::make_shared<Choice>(Choice{ m_model, {}, *reference, (*reference)->notes });
    if (m_given) {
        choice->parameters = *m_given;
        return ChoicePtr(choice);
    }
    PhotoReader photo(source, subimage, 0, stored, converter, threads);
    const auto thumbnail = photo.thumbnail();
    if (!thumbnail)
        return thumbnail.error();
    auto parameters = select(*m_model, *thumbnail, (*reference)->thumbnail);
    if (!parameters)
        return Error{ source.name() + ": " + parameters.error().message };
    choice->parameters = *parameters;
    choice->parameters.reference_name = (*reference)->name;
    choice->parameters.reference_hash = (*reference)->hash;
    const auto pixel_notes = photo.counts().notes();
    choice->notes.insert(choice->notes.end(), pixel_notes.begin(), pixel_notes.end());
    return ChoicePtr(choice);
}

} // namespace srisp
