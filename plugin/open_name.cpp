// SPDX-License-Identifier: Apache-2.0
#include "open_name.h"

#include <filesystem>

#include <sys/stat.h>
#include <unistd.h>

#include <OpenImageIO/strutil.h>

#include "base/input_file.h"
#include "base/json_text.h"
#include "base/shown_text.h"
#include "hand_over.h"
#include "photo/pixel_source.h"
#include "process_state.h"
#include "recipe/frame_pattern.h"
#include "result/recipe_source.h"

namespace srisp::plugin {

namespace {

namespace Strutil = OIIO::Strutil;

const std::string kExtension = ".srisp";
const std::string kHintPrefix = "srisp:";

int hex_digit(char c)
{
    const std::size_t value = std::string("0123456789abcdef").find(Strutil::lower(std::string(1, c)));
    return value == std::string::npos ? -1 : static_cast<int>(value);
}

Expected<std::string> percent_decoded(const std::string& text)
{
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : -1;
        if (high < 0 || low < 0)
            return Error{ "'" + shown_text(first_characters(std::string_view(text).substr(i), 3)) +
                          "' in the query is not a percent code (write %25 for %)" };
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return decoded;
}

bool exists(const std::string& path)
{
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
}

/// The settings of a query and of hints, on top of what a file on disk says.
Status apply_settings(Recipe& recipe, const QueryName& parts, const OIIO::ImageSpec& config)
{
    if (const Status applied = apply_query(recipe, parts.query); !applied)
        return Error{ "'" + parts.file + "': " + applied.error().message };
    if (const Status applied = apply_hints(recipe, config); !applied)
        return Error{ "'" + parts.file + "': " + applied.error().message };
    take_as_development(recipe);
    return check_complete(recipe, "'" + parts.file + "'");
}

Expected<OpenedName> opened(Expected<std::unique_ptr<ComputedImage>> result)
{
    if (!result)
        return result.error();
    return OpenedName{ std::move(*result), nullptr };
}

Expected<OpenedName> open_stub(const QueryName& parts, const std::string& slot_id, const OIIO::ImageSpec& config)
{
    const auto slot = process_state().slots.find(slot_id);
    if (!slot)
        return Error{ "'" + parts.file + "': the image that it stood for was in the memory of another process" };
    auto job = read_job(parts.file);
    if (!job)
        return job.error();
    job->name = with_frame(job->name, slot->frame);
    if (const Status applied = apply_settings(*job, parts, config); !applied)
        return applied.error();
    if (job->gain_map == GainMapUse::apply)
        return Error{ job->name + ": gainmap=apply reads a gain map from the photo's file; no other command may stand "
                                  "between the file's name and --srisp-unprocess" };
    return opened(open_computed_image(*job, open_slot_source(slot_id, job->name), config, process_state().results));
}

/// What srisptool lets oiiotool read in place of a photo's frames: `T/1.0007.srisp`, which is not on disk or an empty
/// stub; the job `T/1.json` says what is meant. None: the name is another.
std::optional<Recipe> recipe_of_frame(const QueryName& parts)
{
    const StubName name = parse_stub_name(parts.file);
    if (name.frame.empty() || !parts.query.empty() || !exists(name.job))
        return {};
    auto job = read_job(parts.file);
    if (!job || job->source.empty())
        return {};
    std::filesystem::path source = job->source;
    source.replace_filename(with_frame(source.filename().string(), name.frame));
    job->source = source.string();
    return std::move(*job);
}

Expected<OpenedName> open_recipe(const Recipe& recipe, const OIIO::ImageSpec& config)
{
    const std::string kind = recipe.direction == Direction::forward ? "image" : "photo";
    if (parse_name(recipe.source))
        return Error{ kind + " '" + recipe.source + "': a recipe cannot be made from a recipe" };
    if (recipe.action == Recipe::Action::read) {
        auto file = ImageFile::open(recipe.source, reading_hints(recipe, config), kind + " '" + recipe.source + "'");
        if (!file)
            return file.error();
        return OpenedName{ nullptr, std::move(*file), recipe.notes };
    }
    auto source = open_recipe_source(recipe, config);
    if (!source)
        return source.error();
    return opened(open_computed_image(recipe, std::move(*source), config, process_state().results));
}

} // namespace

std::optional<QueryName> parse_name(const std::string& name)
{
    QueryName parts;
    const std::string lower = Strutil::lower(name);
    std::size_t end = lower.find(kExtension + "?");
    if (end == std::string::npos) {
        if (!Strutil::ends_with(lower, kExtension))
            return {};
        end = name.size() - kExtension.size();
    } else {
        parts.query = name.substr(end + kExtension.size() + 1);
    }
    parts.source = name.substr(0, end);
    parts.file = name.substr(0, end + kExtension.size());
    return parts.source.empty() ? std::nullopt : std::optional<QueryName>(parts);
}

Status apply_query(Recipe& recipe, const std::string& query)
{
    for (std::size_t start = 0; start < query.size();) {
        const std::size_t end = std::min(query.find('&', start), query.size());
        const std::string item = query.substr(start, end - start);
        start = end + 1;
        const std::size_t equals = item.find('=');
        if (equals == std::string::npos)
            return Error{ "'" + shown_text(item) + "' in the query is not key=value" };
        const auto key = percent_decoded(item.substr(0, equals));
        const auto value = percent_decoded(item.substr(equals + 1));
        if (!key || !value)
            return key ? value.error() : key.error();
        if (const Status set = set_by_text(recipe, *key, *value); !set)
            return set;
    }
    return {};
}

Status apply_hints(Recipe& recipe, const OIIO::ImageSpec& config)
{
    for (const OIIO::ParamValue& hint : config.extra_attribs) {
        const std::string name = hint.name().string();
        if (!Strutil::istarts_with(name, kHintPrefix))
            continue;
        if (const Status set = set_by_text(recipe, name.substr(kHintPrefix.size()), hint.get_string()); !set)
            return Error{ "configuration hint '" + name + "': " + set.error().message };
    }
    return {};
}

/// A job says where parameters are saved: that of a stranger, who put it beside what a user writes, is none.
static bool is_private(const std::filesystem::path& folder)
{
    struct stat info {};
    return ::stat(folder.empty() ? "." : folder.c_str(), &info) == 0 && info.st_uid == ::geteuid() &&
           (info.st_mode & (S_IRWXG | S_IRWXO)) == 0;
}

Expected<Recipe> read_job(const std::string& stub_path)
{
    const auto [path, frame] = parse_stub_name(stub_path);
    if (!is_private(std::filesystem::path(path).parent_path()))
        return Error{ "job '" + path + "' does not lie in a folder that srisptool made for itself" };
    auto text = read_text_file(path, kLargestJson);
    if (!text)
        return Error{ "job " + text.error().message };
    auto job = recipe_from_json(*text, path, true);
    if (job && job->name.empty())
        job->name = frame.empty() ? "image" : "frame " + frame;
    return job;
}

bool is_our_name(const std::string& name)
{
    const auto parts = parse_name(name);
    if (!parts)
        return false;
    if (!exists(parts->file))
        return true;
    const auto text = read_text_file(parts->file, kLargestJson);
    return !text || text->find("\"srisp-") != std::string::npos; // why it cannot be read, we say
}

Expected<OpenedName> open_name(const std::string& name, const OIIO::ImageSpec& config)
{
    const auto parts = parse_name(name);
    if (!parts)
        return Error{ "'" + name +
                      "': is not a name that srisp reads; those end in .srisp or hold .srisp?reference=…" };
    Recipe recipe;
    recipe.source = parts->source;
    recipe.path = parts->file;
    std::optional<Recipe> of_frame;
    if (!exists(parts->file)) {
        of_frame = recipe_of_frame(*parts);
    } else {
        const auto text = read_text_file(parts->file, kLargestJson);
        if (!text)
            return Error{ "recipe " + text.error().message };
        const auto slot_id = parse_stub(*text);
        if (slot_id && slot_id->empty())
            of_frame = recipe_of_frame(*parts);
        if (slot_id && !of_frame)
            return open_stub(*parts, *slot_id, config);
        if (!slot_id) {
            auto read = recipe_from_json(*text, parts->file, false);
            if (!read)
                return read.error();
            recipe = *read;
        }
    }
    if (of_frame)
        recipe = *of_frame;
    if (const Status applied = apply_settings(recipe, *parts, config); !applied)
        return applied.error();
    return open_recipe(recipe, config);
}

} // namespace srisp::plugin
