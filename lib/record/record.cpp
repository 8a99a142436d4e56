// SPDX-License-Identifier: Apache-2.0
#include "record/record.h"

#include <vector>

#include <OpenImageIO/strutil.h>

#include "base/json_text.h"
#include "record/private_facts.h"

namespace srisp {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

const char kHistory[] = "Exif:ImageHistory";
const char kStart[] = "{\"srisp\":";
constexpr std::size_t kLargestLine = std::size_t(64) << 20; // bytes; descriptions of microscopes have some MB

/// An attribute of one value. `kept`: it holds for the result's own pixels, too; levels and filters do not.
template<class Value> struct Fact {
    const char* name;
    Value CameraFacts::*value;
    bool kept;
};

constexpr Fact<std::string> kTexts[] = { { "unprocess:reference_make", &CameraFacts::make, true },
                                         { "unprocess:reference_model", &CameraFacts::model, true },
                                         { "unprocess:reference_cfa_pattern", &CameraFacts::cfa_pattern, false } };
constexpr Fact<float> kNumbers[] = { { "unprocess:reference_iso", &CameraFacts::iso, true },
                                     { "unprocess:reference_exposure_time", &CameraFacts::exposure_time_s, true },
                                     { "unprocess:reference_f_number", &CameraFacts::f_number, true },
                                     { "unprocess:reference_white_level", &CameraFacts::white_level, false } };
const char kReferenceBlackLevel[] = "unprocess:reference_black_level";
const char kAsShotNeutral[] = "unprocess:reference_as_shot_neutral";
const char kReferenceNoiseProfile[] = "unprocess:reference_noise_profile";
/// The daylight matrix, and one for another light.
constexpr struct {
    const char *matrix, *illuminant, *forward;
} kMatrices[] = { { "unprocess:xyz_to_camera", "unprocess:xyz_to_camera_illuminant", "unprocess:forward_matrix" },
                  { "unprocess:xyz_to_camera2", "unprocess:xyz_to_camera2_illuminant", "unprocess:forward_matrix2" } };

OIIO::TypeDesc floats(std::size_t count)
{
    return OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, static_cast<int>(count));
}

/// The JSON object at `start`, to its closing brace; empty where it does not close.
std::string_view object_at(const std::string_view text, std::size_t start)
{
    int depth = 0;
    bool quoted = false;
    for (std::size_t i = start; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '\\')
            ++i;
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && c == '{')
            ++depth;
        else if (!quoted && c == '}' && --depth == 0)
            return text.substr(start, i + 1 - start);
    }
    return {};
}

} // namespace

const char* synthetic_mark(Direction direction)
{
    return direction == Direction::reverse ? "synthetic RAW-like image, computed from a photo; no sensor recorded it"
                                           : "synthetic image, processed from a RAW-like one; no camera made it";
}

std::string format_record(const RecordLine& record)
{
    ordered_json line = { { "srisp", synthetic_mark(record.direction) },
                          { "direction", record.direction == Direction::reverse ? "reverse" : "forward" } };
    if (!record.parameters.empty())
        if (auto parameters = parse_json<ordered_json>(record.parameters))
            line["parameters"] = std::move(*parameters);
    if (!record.sensor.empty())
        if (auto sensor = parse_json<ordered_json>(record.sensor))
            line["sensor"] = std::move(*sensor);
    if (!record.development.empty())
        if (auto development = parse_json<ordered_json>(record.development))
            line["development"] = std::move(*development);
    if (!record.description.empty())
        line["description"] = record.description;
    return line.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
}

std::optional<RecordLine> find_record(const std::string& text)
{
    const std::size_t start = text.find(kStart);
    if (start == std::string::npos)
        return {};
    const auto parsed = parse_json<json>(object_at(text, start), kLargestLine);
    if (!parsed || !parsed->is_object())
        return {};
    const json& line = *parsed;
    const auto text_of = [&](const char* key) {
        const auto found = line.find(key);
        return found != line.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    return RecordLine{ text_of("direction") == "forward" ? Direction::forward : Direction::reverse,
                       line.contains("parameters") ? line["parameters"].dump() : "", text_of("description"),
                       line.contains("sensor") ? line["sensor"].dump() : "",
                       line.contains("development") ? line["development"].dump() : "" };
}

std::optional<RecordLine> read_record(const OIIO::ImageSpec& spec)
{
    const auto record = find_record(spec.get_string_attribute(attribute::kRecord));
    return record ? record : find_record(spec.get_string_attribute("ImageDescription"));
}

void write_record(OIIO::ImageSpec& spec, const RecordLine& record)
{
    const std::string line = format_record(record);
    spec.attribute("ImageDescription", line);
    // Captions get edited; EXR keeps this one as well.
    spec.attribute(attribute::kRecord, line);
}

void record_development(OIIO::ImageSpec& spec, const SceneLinearSpace& space, const std::string& development)
{
    erase_private_facts(spec); // of a camera's own file
    if (auto record = read_record(spec)) {
        record->development = development;
        write_record(spec, *record);
        spec.attribute(attribute::kColorSpace, space.name);
    }
    spec.attribute("oiio:ColorSpace", space.name);
    spec.attribute("colorInteropID", space.interop_id);
    spec.attribute("chromaticities", floats(8), space.chromaticities.data());
    spec.attribute("adoptedNeutral", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::VEC2), space.white.data());
}

std::string recorded_development(const OIIO::ImageSpec& spec)
{
    const auto record = read_record(spec);
    return record ? record->development : "";
}

std::string recorded_space(const OIIO::ImageSpec& spec)
{
    const auto development = parse_json<json>(recorded_development(spec));
    if (!development || !development->is_object())
        return {};
    const auto space = development->find("space");
    return space != development->end() && space->is_string() ? space->get<std::string>() : std::string();
}

void append_history(OIIO::ImageSpec& spec, const std::string& typed)
{
    const std::string command = without_folders(typed);
    const std::string history = spec.get_string_attribute(kHistory);
    if (!command.empty() && !OIIO::Strutil::ends_with(history, command))
        spec.attribute(kHistory, history + (history.empty() ? "" : "\n") + command);
}

void write_camera(OIIO::ImageSpec& spec, const CameraFacts& facts)
{
    for (const auto& [name, value, kept] : kTexts)
        if (!(facts.*value).empty())
            spec.attribute(name, facts.*value);
    for (const auto& [name, value, kept] : kNumbers)
        if (facts.*value > 0)
            spec.attribute(name, facts.*value);
    if (facts.white_level > 0)
        spec.attribute(kReferenceBlackLevel, floats(4), facts.black_level.data());
    if (facts.as_shot_neutral[1] > 0)
        spec.attribute(kAsShotNeutral, floats(3), facts.as_shot_neutral.data());
    if (!facts.noise_profile.empty()) {
        const std::vector<float> noise(facts.noise_profile.begin(), facts.noise_profile.end());
        spec.attribute(kReferenceNoiseProfile, floats(noise.size()), noise.data());
    }
    const CameraFacts::ColorMatrix* const daylight = facts.daylight_matrix();
    const CameraFacts::ColorMatrix* other = nullptr;
    for (const CameraFacts::ColorMatrix& matrix : facts.color_matrices)
        if (&matrix != daylight && !other)
            other = &matrix;
    const CameraFacts::ColorMatrix* const matrices[] = { daylight, other };
    for (std::size_t i = 0; i < std::size(kMatrices); ++i)
        if (const CameraFacts::ColorMatrix* const matrix = matrices[i]) {
            spec.attribute(kMatrices[i].matrix, OIIO::TypeMatrix33, matrix->xyz_to_camera.data());
            if (matrix->illuminant)
                spec.attribute(kMatrices[i].illuminant, matrix->illuminant);
            if (matrix->forward != decltype(matrix->forward){})
                spec.attribute(kMatrices[i].forward, OIIO::TypeMatrix33, matrix->forward.data());
        }
}

/// What TIFF and PNG keep of it: the parameters in the record.
static std::array<float, 3> neutral_of_parameters(const OIIO::ImageSpec& spec)
{
    const auto record = read_record(spec);
    if (!record || record->direction != Direction::reverse || record->parameters.empty())
        return {};
    const auto parameters = parameters_from_json(record->parameters, "record");
    if (!parameters)
        return {};
    const auto& [red, green, blue] = parameters->white_balance;
    return { green / red, 1, green / blue };
}

CameraFacts recorded_camera(const OIIO::ImageSpec& spec)
{
    CameraFacts facts;
    for (const auto& [name, value, kept] : kTexts)
        if (kept)
            facts.*value = spec.get_string_attribute(name);
    for (const auto& [name, value, kept] : kNumbers)
        if (kept)
            facts.*value = spec.get_float_attribute(name);
    if (!spec.getattribute(attribute::kNeutral, floats(3), facts.as_shot_neutral.data()))
        facts.as_shot_neutral = neutral_of_parameters(spec);
    for (const auto& names : kMatrices) {
        CameraFacts::ColorMatrix matrix;
        if (spec.getattribute(names.matrix, OIIO::TypeMatrix33, matrix.xyz_to_camera.data())) {
            matrix.illuminant = spec.get_int_attribute(names.illuminant);
            spec.getattribute(names.forward, OIIO::TypeMatrix33, matrix.forward.data());
            facts.color_matrices.push_back(matrix);
        }
    }
    return facts;
}

void append_notes(OIIO::ImageSpec& spec, const std::vector<std::string>& notes)
{
    std::vector<std::string> all;
    if (const std::string before = spec.get_string_attribute(attribute::kNotes); !before.empty())
        all.push_back(before);
    all.insert(all.end(), notes.begin(), notes.end());
    if (!all.empty())
        spec.attribute(attribute::kNotes, without_folders(OIIO::Strutil::join(all, "; ")));
}

std::array<float, 3> recorded_reference_neutral(const OIIO::ImageSpec& spec)
{
    std::array<float, 3> neutral{};
    spec.getattribute(kAsShotNeutral, floats(3), neutral.data());
    return neutral;
}

CameraFacts recorded_sensor(const OIIO::ImageSpec& spec)
{
    CameraFacts facts = recorded_camera(spec);
    for (const auto& [name, value, kept] : kTexts)
        facts.*value = spec.get_string_attribute(name);
    for (const auto& [name, value, kept] : kNumbers)
        facts.*value = spec.get_float_attribute(name);
    spec.getattribute(kReferenceBlackLevel, floats(4), facts.black_level.data());
    if (const OIIO::ParamValue* const noise = spec.find_attribute(kReferenceNoiseProfile))
        for (std::size_t i = 0; i < noise->type().numelements(); ++i)
            facts.noise_profile.push_back(noise->get_float_indexed(int(i)));
    return facts;
}

} // namespace srisp
