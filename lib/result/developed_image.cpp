// SPDX-License-Identifier: Apache-2.0
#include "result/developed_image.h"

#include <optional>
#include <vector>

#include <srisp/metadata.h>

#include "base/scene_linear_space.h"
#include "base/shown_text.h"
#include "photo/color_channels.h"
#include "recipe/option_table.h"
#include "record/record.h"
#include "result/kept_results.h"

namespace srisp {

namespace {

/// What is not in a developed picture of a camera's own file.
void erase_camera_facts(OIIO::ImageSpec& spec)
{
    auto& attributes = spec.extra_attribs;
    for (auto at = attributes.begin(); at != attributes.end();)
        at = at->name().string().rfind(attribute::kPrefix, 0) == 0 ? attributes.erase(at) : at + 1;
}

} // namespace

Expected<std::unique_ptr<DevelopedImage>> DevelopedImage::open(const Recipe& recipe, const std::string& name,
                                                               std::unique_ptr<ComputedImage> image, KeptResults& kept)
{
    auto developed = std::unique_ptr<DevelopedImage>(new DevelopedImage(recipe, name, std::move(image), kept));
    if (const Status known = check_space(recipe.develop); !known) // a program's own options were not read by us
        return developed->error(known.error().message);
    const auto first = developed->header(0, 0);
    if (!first)
        return first.error();
    return developed;
}

Expected<DevelopedImage::Level> DevelopedImage::first_look(const OIIO::ImageSpec& spec) const
{
    Level level;
    level.spec = spec;
    const auto record = read_record(spec);
    if (record && record->direction == Direction::forward)
        return error("is a processed picture; RAW-like images are developed");
    if (record && !record->development.empty())
        return error("is developed already, into " + shown_text(recorded_space(spec)));
    const bool camera_rgb = spec.get_string_attribute("oiio:ColorSpace") == kCameraColorSpace ||
                            spec.get_string_attribute(attribute::kColorSpace) == kCameraColorSpace;
    if (!camera_rgb && !record)
        return error("is neither a RAW-like image of srisp's nor a camera's RAW file; --srisp-unprocess makes one of a "
                     "photo");
    if (!recorded_sensor_values(spec).cfa_pattern.empty())
        return error("is a mosaic, which is not developed");
    const auto channels = find_color_channels(spec, m_name);
    if (!channels)
        return channels.error();
    if (channels->color != std::vector<int>{ 0, 1, 2 })
        return error("has " + std::to_string(spec.nchannels) + " channel" + (spec.nchannels == 1 ? "" : "s") +
                     "; images whose first three are R, G, B are developed");
    if (!spec.get_int_attribute("oiio:UnassociatedAlpha"))
        level.alpha = channels->alpha;
    return level;
}

Expected<const OIIO::ImageSpec*> DevelopedImage::header(int subimage, int miplevel)
{
    const auto key = std::make_pair(subimage, miplevel);
    auto found = m_levels.find(key);
    if (found == m_levels.end()) {
        const auto spec = m_image->header(subimage, miplevel);
        if (!spec || !*spec)
            return spec;
        auto level = first_look(**spec);
        if (!level)
            return level.error();
        record_development(level->spec, *find_scene_linear_space(m_recipe.develop), "");
        found = m_levels.emplace(key, std::move(*level)).first;
    }
    return static_cast<const OIIO::ImageSpec*>(&found->second.spec);
}

Expected<const OIIO::ImageSpec*> DevelopedImage::full_spec(int subimage, int miplevel, int threads)
{
    const auto known = m_levels.find({ subimage, miplevel });
    if (known != m_levels.end() && known->second.full)
        return static_cast<const OIIO::ImageSpec*>(&known->second.spec);
    const auto spec = m_image->full_spec(subimage, miplevel, threads);
    if (!spec || !*spec)
        return spec;
    auto level = first_look(**spec);
    if (!level)
        return level.error();
    if (const Status chosen = choose(*level); !chosen)
        return chosen.error();
    return static_cast<const OIIO::ImageSpec*>(&(m_levels[{ subimage, miplevel }] = std::move(*level)).spec);
}

/// What full_spec needs the reference for.
Status DevelopedImage::choose(Level& level) const
{
    const std::optional<RecordLine> record = read_record(level.spec);
    std::optional<Parameters> parameters;
    if (record && !record->parameters.empty()) {
        auto recorded = recorded_parameters(level.spec, m_name);
        if (!recorded)
            return recorded.error();
        parameters = std::move(*recorded);
    }
    const DevelopSource source{ recorded_camera(level.spec), recorded_reference_neutral(level.spec),
                                parameters ? &*parameters : nullptr };
    std::vector<std::string> notes;
    auto development = choose_development(source, m_recipe, notes);
    if (!development)
        return error(development.error().message);
    level.development = std::move(*development);
    append_history(level.spec, m_recipe.command);
    if (!record)
        erase_camera_facts(level.spec);
    record_development(level.spec, *find_scene_linear_space(level.development.space), to_json(level.development));
    append_notes(level.spec, notes);
    if (m_recipe.notes)
        m_kept.print_notes(m_name, notes);
    level.full = true;
    return {};
}

Status DevelopedImage::read(int subimage, int miplevel, int threads, int x0, int x1, int y0, int y1, float* out,
                            std::size_t row_stride)
{
    if (const auto spec = full_spec(subimage, miplevel, threads); !spec)
        return spec.error();
    const Level& level = m_levels.at({ subimage, miplevel });
    if (const Status read = m_image->read(subimage, miplevel, threads, x0, x1, y0, y1, out, row_stride); !read)
        return read;
    const MutableImageView pixels{ out, x1 - x0, y1 - y0, level.spec.nchannels, std::ptrdiff_t(row_stride) };
    const float* const alpha = level.alpha < 0 ? nullptr : out + level.alpha;
    const Status developed = srisp::develop(level.development, pixels, pixels, alpha, threads);
    return developed ? developed : error(developed.error().message);
}

} // namespace srisp
