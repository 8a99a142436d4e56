// SPDX-License-Identifier: Apache-2.0
#include "open_name.h"

#include <filesystem>

#include "base/file_bytes.h"
#include "hand_over.h"
#include "query.h"

namespace srisp {

namespace {

constexpr std::size_t kMostRecipe = 1 << 20; // bytes

bool exists(const std::string& path)
{
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

/// The settings of a query and of hints, on top of what a file on disk says.
Status apply_settings(Recipe& recipe, const QueryName& parts, const OIIO::ImageSpec& config)
{
    if (const Status applied = apply_query(recipe, parts.query); !applied)
        return Error{ "'" + parts.file + "': " + applied.error().message };
    if (const Status applied = apply_hints(recipe, config); !applied)
        return Error{ "'" + parts.file + "': " + applied.error().message };
    return check_complete(recipe, "'" + parts.file + "'");
}

Expected<std::unique_ptr<ResultImage>> open_stub(const QueryName& parts, const std::string& slot_id,
                                                 const OIIO::ImageSpec& config)
{
    if (!find_slot(slot_id))
        return Error{ "'" + parts.file + "': the image that it stood for was in the memory of another process" };
    std::string frame;
    auto job = read_job(parts.file, frame);
    if (!job)
        return job.error();
    if (const Status applied = apply_settings(*job, parts, config); !applied)
        return applied.error();
    return ResultImage::open(*job, open_slot_source(slot_id, job->name), config);
}

} // namespace

Expected<Recipe> read_job(const std::string& stub_path, std::string& frame)
{
    std::string path;
    parse_stub_name(stub_path, path, frame);
    auto text = read_text_file(path, kMostRecipe);
    if (!text)
        return Error{ "job " + text.error().message };
    auto job = recipe_from_json(*text, path, true);
    if (job && job->name.empty())
        job->name = frame.empty() ? "image" : "frame " + frame;
    return job;
}

bool is_our_name(const std::string& name)
{
    QueryName parts;
    if (!parse_name(name, parts))
        return false;
    if (!exists(parts.file))
        return true;
    const auto text = read_text_file(parts.file, kMostRecipe);
    return text && text->find("\"srisp-") != std::string::npos;
}

Expected<std::unique_ptr<ResultImage>> open_name(const std::string& name, const OIIO::ImageSpec& config)
{
    QueryName parts;
    if (!parse_name(name, parts))
        return Error{ "'" + name + "': is no name of srisp's; those end in .srisp or hold .srisp?reference=…" };
    Recipe recipe;
    recipe.source = parts.source;
    recipe.path = parts.file;
    if (exists(parts.file)) {
        const auto text = read_text_file(parts.file, kMostRecipe);
        if (!text)
            return Error{ "recipe " + text.error().message };
        std::string slot_id;
        if (parse_stub(*text, slot_id))
            return open_stub(parts, slot_id, config);
        auto read = recipe_from_json(*text, parts.file, false);
        if (!read)
            return read.error();
        recipe = *read;
    }
    if (const Status applied = apply_settings(recipe, parts, config); !applied)
        return applied.error();
    if (QueryName ours; parse_name(recipe.source, ours))
        return Error{ "source '" + recipe.source + "': a recipe cannot be made from a recipe" };
    auto source = open_file_source(recipe.source, config);
    if (!source)
        return source.error();
    return ResultImage::open(recipe, std::move(*source), config);
}

} // namespace srisp
