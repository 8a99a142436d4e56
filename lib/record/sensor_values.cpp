// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <OpenImageIO/strutil.h>
#include <srisp/metadata.h>

#include "base/json_text.h"
#include "record/record.h"

namespace srisp {

namespace {

using nlohmann::json;

OIIO::TypeDesc floats(std::size_t count)
{
    return OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, static_cast<int>(count));
}

std::string line_of(const SensorValues& values)
{
    nlohmann::ordered_json line = nlohmann::ordered_json::object();
    if (!values.cfa_pattern.empty())
        line["cfa_pattern"] = values.cfa_pattern;
    if (values.has_levels()) {
        line["black_level"] = values.black_level;
        line["white_level"] = values.white_level;
    }
    if (!values.noise_profile.empty())
        line["noise_profile"] = values.noise_profile;
    return line.empty() ? "" : line.dump();
}

/// Numbers of a line that may be anybody's; empty: they are none, or not as many.
std::vector<double> numbers(const json& line, const char* key, std::size_t count)
{
    const auto found = line.find(key);
    std::vector<double> values;
    if (found != line.end() && found->is_array() && found->size() == count)
        for (const json& value : *found)
            values.push_back(value.is_number() ? value.get<double>() : 0.0);
    return values;
}

/// Of an attribute of any type, as users set them: `count` numbers, or fewer that count for all. Empty: there are none,
/// or a number of them that does not fit.
std::vector<float> attribute_numbers(const OIIO::ImageSpec& spec, const char* name, std::size_t count)
{
    const OIIO::ParamValue* const attribute = spec.find_attribute(name);
    std::vector<float> said;
    if (attribute && attribute->type().basetype == OIIO::TypeDesc::STRING)
        said = OIIO::Strutil::extract_from_list_string<float>(attribute->get_string());
    else if (attribute)
        for (std::size_t i = 0; i < attribute->type().basevalues(); ++i)
            said.push_back(attribute->type().basetype == OIIO::TypeDesc::INT ? float(attribute->get_int_indexed(int(i)))
                                                                             : attribute->get_float_indexed(int(i)));
    if (said.empty() || count % said.size() != 0)
        return {};
    std::vector<float> all;
    while (all.size() < count)
        all.insert(all.end(), said.begin(), said.end());
    return all;
}

SensorValues values_of(const std::string& text)
{
    SensorValues values;
    const auto line = parse_json<json>(text);
    if (!line || !line->is_object())
        return values;
    const auto pattern = line->find("cfa_pattern");
    if (pattern != line->end() && pattern->is_string())
        values.cfa_pattern = pattern->get<std::string>();
    const auto black = numbers(*line, "black_level", values.black_level.size());
    std::copy(black.begin(), black.end(), values.black_level.begin());
    const auto white = line->find("white_level");
    if (white != line->end() && white->is_number())
        values.white_level = white->get<float>();
    values.noise_profile = numbers(*line, "noise_profile", 6);
    return values;
}

} // namespace

float SensorValues::code_of(float part)
{
    const float code = part * 65535, whole = std::round(code);
    return std::abs(code - whole) < 1e-2f ? whole : code;
}

void record_sensor_values(OIIO::ImageSpec& spec, const SensorValues& values)
{
    for (const char* name :
         { attribute::kCfaPattern, attribute::kBlackLevel, attribute::kWhiteLevel, attribute::kNoiseProfile })
        spec.erase_attribute(name);
    if (!values.cfa_pattern.empty())
        spec.attribute(attribute::kCfaPattern, values.cfa_pattern);
    if (values.has_levels()) {
        spec.attribute(attribute::kBlackLevel, floats(4), values.black_level.data());
        spec.attribute(attribute::kWhiteLevel, values.white_level);
    }
    if (!values.noise_profile.empty()) {
        const std::vector<float> noise(values.noise_profile.begin(), values.noise_profile.end());
        spec.attribute(attribute::kNoiseProfile, floats(noise.size()), noise.data());
    }
    const auto before = read_record(spec);
    RecordLine record =
        before ? *before : RecordLine{ Direction::reverse, "", spec.get_string_attribute("ImageDescription"), "", "" };
    record.sensor = line_of(values);
    write_record(spec, record);
}

SensorValues recorded_sensor_values(const OIIO::ImageSpec& spec)
{
    const auto record = read_record(spec);
    SensorValues values = record ? values_of(record->sensor) : SensorValues();
    // Attributes win: they can be edited.
    if (const std::string pattern = spec.get_string_attribute(attribute::kCfaPattern); !pattern.empty())
        values.cfa_pattern = pattern;
    if (const auto black = attribute_numbers(spec, attribute::kBlackLevel, 4); !black.empty())
        std::copy(black.begin(), black.end(), values.black_level.begin());
    values.white_level = spec.get_float_attribute(attribute::kWhiteLevel, values.white_level);
    if (const auto noise = attribute_numbers(spec, attribute::kNoiseProfile, 6); !noise.empty())
        values.noise_profile.assign(noise.begin(), noise.end());
    if (spec.nchannels == 1)
        return values;
    // The rest is that of a mosaic which this was made from.
    SensorValues of_colors;
    of_colors.noise_profile = values.noise_profile;
    return of_colors;
}

std::string recorded_cfa_pattern(const OIIO::ImageSpec& spec)
{
    return recorded_sensor_values(spec).cfa_pattern;
}

void record_cfa_pattern(OIIO::ImageSpec& spec, const std::string& pattern)
{
    SensorValues values = recorded_sensor_values(spec);
    values.cfa_pattern = pattern;
    record_sensor_values(spec, values);
}

} // namespace srisp
