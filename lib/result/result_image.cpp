// SPDX-License-Identifier: Apache-2.0
#include "result/result_image.h"

#include <srisp/metadata.h>

#include "record/record.h"

namespace srisp {

namespace {

/// A forward pass takes values as they are.
InputEncoding encoding_of(const Recipe& recipe)
{
    return recipe.direction == Direction::forward ? InputEncoding::camera : recipe.input;
}

} // namespace

Expected<std::unique_ptr<ResultImage>> ResultImage::open(const Recipe& recipe, std::unique_ptr<PixelSource> source,
                                                         const OIIO::ImageSpec& config, KeptResults& kept)
{
    auto chooser = Chooser::create(recipe, kept);
    if (!chooser)
        return chooser.error();
    const bool associate = config.get_int_attribute("oiio:UnassociatedAlpha") == 0;
    auto image =
        std::unique_ptr<ResultImage>(new ResultImage(recipe, std::move(source), std::move(*chooser), associate, kept));
    const auto first = image->existing_level(0, 0);
    if (!first)
        return first.error();
    return image;
}

Expected<ResultImage::Level*> ResultImage::level(int subimage, int miplevel)
{
    const auto key = std::make_pair(subimage, miplevel);
    if (const auto found = m_levels.find(key); found != m_levels.end())
        return &found->second;
    const auto stored = subimage < 0 || miplevel < 0 ? std::nullopt : m_source->find_level(subimage, miplevel);
    if (!stored)
        return static_cast<Level*>(nullptr);
    Level level;
    level.stored = *stored;
    auto converter = PhotoConverter::create(level.stored, encoding_of(m_recipe), m_source->name());
    if (!converter)
        return converter.error();
    level.converter = std::make_shared<PhotoConverter>(std::move(*converter));
    level.result = level.converter->output_spec();
    // MIP levels take the parameters of their largest.
    const auto largest = miplevel > 0 ? m_source->find_level(subimage, 0) : stored;
    auto known = m_chooser.known(*m_source, subimage, largest ? *largest : *stored);
    if (!known)
        return known.error();
    if (*known)
        record(level, **known);
    else
        mark_result(level.result, m_recipe.direction);
    mark_straight(level);
    return &m_levels.emplace(key, std::move(level)).first->second;
}

Expected<ResultImage::Level*> ResultImage::existing_level(int subimage, int miplevel)
{
    auto found = level(subimage, miplevel);
    if (found && !*found)
        return Error{ m_source->name() + ": has no subimage " + std::to_string(subimage) + " with MIP level " +
                      std::to_string(miplevel) };
    return found;
}

void ResultImage::record(Level& level, const Choice& choice) const
{
    record_result(level.result, choice.parameters, choice.reference ? &choice.reference->facts : nullptr,
                  m_recipe.direction);
    std::vector<std::string> notes = level.converter->notes();
    notes.insert(notes.end(), choice.notes.begin(), choice.notes.end());
    append_notes(level.result, notes);
    append_history(level.result, m_recipe.command);
    level.recorded = true;
}

void ResultImage::mark_straight(Level& level) const
{
    if (!m_associate && level.result.alpha_channel >= 0)
        level.result.attribute("oiio:UnassociatedAlpha", 1);
}

void ResultImage::tell(const Level& level, const std::vector<std::string>& notes) const
{
    if (!m_recipe.notes)
        return;
    m_kept.print_notes(m_source->name(), level.converter->notes());
    m_kept.print_notes(m_source->name(), notes);
}

Expected<const OIIO::ImageSpec*> ResultImage::header(int subimage, int miplevel)
{
    const auto found = level(subimage, miplevel);
    if (!found)
        return found.error();
    return static_cast<const OIIO::ImageSpec*>(*found ? &(*found)->result : nullptr);
}

Expected<ChoicePtr> ResultImage::choice(int subimage, int threads)
{
    const auto largest = existing_level(subimage, 0);
    if (!largest)
        return largest.error();
    auto chosen = m_chooser.choose(*m_source, subimage, (*largest)->stored, *(*largest)->converter, threads);
    if (chosen)
        tell(**largest, (*chosen)->notes);
    return chosen;
}

Expected<const OIIO::ImageSpec*> ResultImage::full_spec(int subimage, int miplevel, int threads)
{
    const auto found = existing_level(subimage, miplevel);
    if (!found)
        return found.error();
    if (!(*found)->recorded) {
        const auto chosen = choice(subimage, threads);
        if (!chosen)
            return chosen.error();
        // Marked before as unrecorded: start from the photo's own spec.
        (*found)->result = (*found)->converter->output_spec();
        record(**found, **chosen);
        mark_straight(**found);
    }
    return static_cast<const OIIO::ImageSpec*>(&(*found)->result);
}

void ResultImage::drop_idle_readers()
{
    constexpr std::size_t kMostReaders = 4; // 100 MB each for 24 Mpx; textures are read at several levels in turn
    std::size_t count = 0;
    for (const auto& level : m_levels)
        count += level.second.bands != nullptr;
    if (count >= kMostReaders)
        for (auto& level : m_levels)
            level.second.bands.reset();
}

Expected<std::shared_ptr<BandReader>> ResultImage::band_reader(int subimage, int miplevel, int threads)
{
    const auto found = existing_level(subimage, miplevel);
    if (!found)
        return found.error();
    if (!(*found)->bands) {
        std::shared_ptr<const Applier>& applier = m_appliers[subimage];
        if (!applier) {
            const auto chosen = choice(subimage, threads);
            if (!chosen)
                return chosen.error();
            auto created =
                Applier::create(*(*chosen)->model, (*chosen)->parameters, m_recipe.direction, m_recipe.precision);
            if (!created)
                return Error{ m_source->name() + ": " + created.error().message };
            applier = *created;
        }
        drop_idle_readers();
        (*found)->bands = std::make_shared<BandReader>(
            *m_source, subimage, miplevel, (*found)->stored,
            BandSettings{ (*found)->converter, applier, m_associate, m_recipe.progress, threads, m_recipe.cancelled });
    }
    return (*found)->bands;
}

Status ResultImage::read(int subimage, int miplevel, int threads, int x0, int x1, int y0, int y1, float* out,
                         std::size_t row_stride)
{
    // Shared: a call within this one may drop idle readers.
    const auto bands = band_reader(subimage, miplevel, threads);
    if (!bands)
        return bands.error();
    const Status done = (*bands)->read(x0, x1, y0, y1, out, row_stride);
    if (done && miplevel == 0 && (*bands)->complete()) {
        tell(m_levels.at({ subimage, miplevel }), (*bands)->counts().notes());
        tell(m_levels.at({ subimage, miplevel }), m_source->notes());
    }
    return done;
}

} // namespace srisp
