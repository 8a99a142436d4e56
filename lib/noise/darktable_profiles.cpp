// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <optional>
#include <vector>

#include <srisp/noise.h>

#include "base/guarded.h"
#include "base/input_file.h"
#include "base/json_text.h"
#include "base/near_names.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

using nlohmann::json;

constexpr std::size_t kLargestProfiles = std::size_t(16) << 20; // bytes; darktable 4.2's has 1.5 million

/// What names are compared by.
std::string folded(const std::string& name)
{
    std::string letters;
    for (const unsigned char c : name)
        if (!std::isspace(c))
            letters += char(std::tolower(c));
    return letters;
}

bool begins_with(const std::string& text, const std::string& start)
{
    return text.compare(0, start.size(), start) == 0;
}

/// A folded model without its make before it ("Canon EOS 5D").
std::string bare_model(const std::string& model, const std::string& make)
{
    return begins_with(model, make) && model.size() > make.size() ? model.substr(make.size()) : model;
}

/// A list of an object; null where it is none.
const json* list_of(const json& object, const char* key)
{
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() && found->is_array() ? &*found : nullptr;
}

std::string text_of(const json& object, const char* key)
{
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

/// One measured ISO of a camera.
struct Measured {
    double iso;
    NoiseModel noise;
};

/// Reads an entry; nothing where it has other values than it must.
std::optional<Measured> measured(const json& entry)
{
    const json *a = list_of(entry, "a"), *b = list_of(entry, "b");
    if (!a || !b || a->size() != 3 || b->size() != 3 || !entry.contains("iso") || !entry["iso"].is_number())
        return {};
    Measured result{ entry["iso"].get<double>(), {} };
    for (std::size_t c = 0; c < 3; ++c) {
        if (!(*a)[c].is_number() || !(*b)[c].is_number())
            return {};
        result.noise.shot[c] = std::max((*a)[c].get<double>(), 0.0);
        result.noise.read[c] = std::max((*b)[c].get<double>(), 0.0);
    }
    if (!(result.iso > 0) || !check_noise(result.noise))
        return {};
    return result;
}

/// The camera's object, or why there is none.
Expected<const json*> find_camera(const json& file, const std::string& make, const std::string& model)
{
    const json* makers = list_of(file, "noiseprofiles");
    if (!makers)
        return Error{ "no list 'noiseprofiles', as darktable's noiseprofiles.json has it" };
    if (const auto version = file.find("version"); version != file.end() && *version != 0)
        return Error{ "version " + shown_json(*version) + " of noise profiles: only 0 is known" };
    const std::string wanted_make = folded(make), wanted_model = folded(model);
    std::vector<std::string> models, makes;
    for (const json& maker : *makers) {
        const std::string name = folded(text_of(maker, "maker"));
        const json* of_maker = list_of(maker, "models");
        if (name.empty() || !of_maker)
            continue;
        makes.push_back(text_of(maker, "maker"));
        if (!begins_with(wanted_make, name)) // EXIF has "NIKON CORPORATION"
            continue;
        for (const json& camera : *of_maker) {
            models.push_back(text_of(camera, "model"));
            if (bare_model(folded(models.back()), name) == bare_model(wanted_model, name))
                return &camera;
        }
    }
    const std::string camera = "no noise profile of '" + shown_text(make) + "' '" + shown_text(model) + "'";
    return Error{ camera + (models.empty() ? near_names(make, makes) : near_names(model, models)) };
}

/// The entries to use, by ISO.
Expected<std::vector<Measured>> measured_of(const json& camera)
{
    std::vector<Measured> result;
    const json* profiles = list_of(camera, "profiles");
    for (const json& entry : profiles ? *profiles : json::array()) {
        if (entry.is_object() && entry.value("skip", json()) == json(true))
            continue;
        const auto one = measured(entry);
        if (!one)
            return Error{ "noise profile '" + shown_text(text_of(entry, "name")) +
                          "': needs an iso above 0, and three numbers below 1 each as a and b" };
        result.push_back(*one);
    }
    if (result.empty())
        return Error{ "noise profiles of '" + shown_text(text_of(camera, "model")) + "': none to use" };
    std::stable_sort(result.begin(), result.end(),
                     [](const Measured& one, const Measured& other) { return one.iso < other.iso; });
    return result;
}

Expected<NoiseModel> interpolated(const std::vector<Measured>& points, double iso)
{
    if (!(iso >= points.front().iso && iso <= points.back().iso))
        return Error{ "ISO " + shown_number(iso) + " is outside of the camera's noise profiles, " +
                      shown_number(points.front().iso) + " to " + shown_number(points.back().iso) };
    const auto above =
        std::find_if(points.begin(), points.end(), [&](const Measured& point) { return point.iso >= iso; });
    if (above->iso == iso)
        return above->noise;
    const Measured& below = *(above - 1);
    const double t = (iso - below.iso) / (above->iso - below.iso);
    NoiseModel noise;
    for (std::size_t c = 0; c < 3; ++c) {
        noise.shot[c] = (1 - t) * below.noise.shot[c] + t * above->noise.shot[c];
        noise.read[c] = (1 - t) * below.noise.read[c] + t * above->noise.read[c];
    }
    return noise;
}

Expected<NoiseModel> noise_of(const json& file, const std::string& make, const std::string& model, double iso)
{
    const auto camera = find_camera(file, make, model);
    if (!camera)
        return camera.error();
    const auto points = measured_of(**camera);
    return points ? interpolated(*points, iso) : Expected<NoiseModel>(points.error());
}

} // namespace

Expected<NoiseModel> darktable_noise(const std::string& path, const std::string& make, const std::string& model,
                                     double iso)
{
    return guarded("noise profiles", path, [&]() -> Expected<NoiseModel> {
        const auto text = read_text_file(path, kLargestProfiles);
        if (!text)
            return text.error();
        const std::string where = "'" + path + "'";
        const auto file = parse_json_object(*text, where, "file", kLargestProfiles);
        if (!file)
            return file.error();
        const auto noise = noise_of(*file, make, model, iso);
        return noise ? noise : Expected<NoiseModel>(Error{ where + ": " + noise.error().message });
    });
}

} // namespace srisp
