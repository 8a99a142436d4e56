// SPDX-License-Identifier: Apache-2.0
#include "result/chooser.h"

#include <filesystem>

#include <srisp/metadata.h>
#include <srisp/select.h>

#include "photo/photo_reader.h"

namespace srisp {

namespace {

std::string held_key(const Recipe& recipe, int subimage)
{
    return recipe.path + "\n" + std::to_string(subimage);
}

} // namespace

Expected<Chooser> Chooser::create(const Recipe& recipe, KeptResults& kept)
{
    Chooser chooser(kept);
    chooser.m_recipe = recipe;
    const std::optional<Parameters>& given = recipe.parameters;
    const bool reverse = recipe.direction == Direction::reverse;
    const bool named = given && !given->model_name.empty();
    if (given && !named && recipe.model.empty() && !reverse)
        return Error{ "the parameters name no model, so it must be given (model=)" };
    if (!recipe.model.empty() || named || reverse) {
        auto loaded = !recipe.model.empty() ? kept.load_model(recipe.model)
                      : named               ? kept.find_model_of(*given)
                                            : kept.load_model("default");
        if (!loaded)
            return loaded.error();
        chooser.m_model = *loaded;
    }
    if (given)
        if (const Status fits = check_parameters(*given, *chooser.m_model); !fits)
            return fits.error();
    if (!recipe.reference && !recipe.references.empty() && reverse) {
        auto reference = choose_reference(recipe.references, recipe.seed, recipe.photo_name());
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
           "\n" + m_model->hash() + "\n" + (m_recipe.parameters ? to_json(*m_recipe.parameters, -1) : "") + "\n" +
           (m_recipe.reference ? m_recipe.reference->hash : reference_state(m_reference));
}

Choice Chooser::given() const
{
    Choice choice{ m_model, *m_recipe.parameters, nullptr, {} };
    if (const std::string note = brightness_note(choice.parameters); !note.empty())
        choice.notes.push_back(note);
    return choice;
}

Expected<std::shared_ptr<const Reference>> Chooser::reference() const
{
    if (m_recipe.reference)
        return m_recipe.reference;
    return load_reference_cached(m_reference, m_recipe.isolate);
}

Expected<ChoicePtr> Chooser::finished(const PixelSource& source, int subimage, ChoicePtr choice) const
{
    if (m_recipe.brightness) {
        Choice changed = *choice;
        const Status chosen = choose_brightness(changed.parameters, *m_recipe.brightness, m_recipe.seed,
                                                m_recipe.photo_name(), &changed.notes);
        if (!chosen)
            return Error{ source.name() + ": " + chosen.error().message };
        choice = std::make_shared<const Choice>(std::move(changed));
    }
    return m_recipe.hold ? m_kept->held_choices.keep(held_key(m_recipe, subimage), choice) : choice;
}

Expected<ChoicePtr> Chooser::known(const PixelSource& source, int subimage, const OIIO::ImageSpec& stored) const
{
    if (m_recipe.direction == Direction::reverse) {
        if (const ChoicePtr held = m_recipe.hold ? m_kept->held_choices.find(held_key(m_recipe, subimage)) : nullptr)
            return held;
        const ChoicePtr choice = m_recipe.parameters && !has_reference() ? std::make_shared<const Choice>(given())
                                                                         : m_kept->choices.find(key(source, subimage));
        return choice ? finished(source, subimage, choice) : choice;
    }
    if (!m_recipe.parameters && !is_unprocessed(stored))
        return Error{ source.name() +
                      ": is not a RAW-like image of srisp's, so it records no parameters; give params=" };
    auto parameters =
        m_recipe.parameters ? Expected<Parameters>(*m_recipe.parameters) : recorded_parameters(stored, source.name());
    if (!parameters)
        return parameters.error();
    auto model = m_model ? Expected<std::shared_ptr<const Model>>(m_model) : m_kept->find_model_of(*parameters);
    if (!model)
        return Error{ source.name() + ": " + model.error().message };
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
    return finished(source, subimage, m_kept->choices.keep(key(source, subimage), *choice));
}

Expected<std::shared_ptr<const PreparedReference>> Chooser::prepared(const Reference& reference) const
{
    using Prepared = std::shared_ptr<const PreparedReference>;
    return m_kept->references.get(reference.hash + "\n" + m_model->hash(), [&]() -> Expected<Prepared> {
        const auto made = prepare_reference(*m_model, reference.thumbnail);
        return made ? Prepared(std::make_shared<const PreparedReference>(*made)) : Expected<Prepared>(made.error());
    });
}

Expected<ChoicePtr> Chooser::select_new(PixelSource& source, int subimage, const OIIO::ImageSpec& stored,
                                        const PhotoConverter& converter, int threads) const
{
    const auto reference = this->reference();
    if (!reference)
        return reference.error();
    if (m_recipe.parameters) {
        auto choice = std::make_shared<Choice>(given());
        choice->reference = *reference;
        choice->notes.insert(choice->notes.begin(), (*reference)->notes.begin(), (*reference)->notes.end());
        return ChoicePtr(choice);
    }
    auto choice = std::make_shared<Choice>(Choice{ m_model, {}, *reference, (*reference)->notes });
    const auto features = prepared(**reference);
    if (!features)
        return Error{ source.name() + ": " + features.error().message };
    source.expect_second_pass(subimage);
    PhotoReader photo(source, subimage, 0, stored, converter, threads);
    const auto thumbnail = photo.thumbnail(m_recipe.cancelled);
    if (!thumbnail)
        return thumbnail.error();
    auto parameters = select(*m_model, *thumbnail, **features, &choice->notes);
    if (!parameters)
        return Error{ source.name() + ": " + parameters.error().message };
    choice->parameters = *parameters;
    choice->parameters.reference_name = (*reference)->name;
    choice->parameters.reference_hash = (*reference)->hash;
    const auto pixel_notes = photo.counts().notes();
    choice->notes.insert(choice->notes.end(), pixel_notes.begin(), pixel_notes.end());
    choice->notes.insert(choice->notes.end(), source.notes().begin(), source.notes().end());
    return ChoicePtr(choice);
}

} // namespace srisp
