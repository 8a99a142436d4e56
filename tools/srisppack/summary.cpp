// SPDX-License-Identifier: Apache-2.0
#include "summary.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace srisp::tool {

namespace {

using nlohmann::json;

/// "  251  MIT (repo)" lines, most frequent first.
std::string table(const std::map<std::string, int>& counts)
{
    std::vector<std::pair<std::string, int>> sorted(counts.begin(), counts.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    std::string text;
    for (const auto& [name, count] : sorted) {
        const std::string number = std::to_string(count);
        text += std::string(number.size() < 8 ? 8 - number.size() : 0, ' ') + number + "  " + name + "\n";
    }
    return text;
}

std::string part_text(const char* title, const PartReport& part)
{
    std::string text = std::string(title) + ": " + std::to_string(part.scenes) + " scenes, " +
                       std::to_string(part.images) + " images of " + std::to_string(part.size) + " x " +
                       std::to_string(part.size) + " pixels; " + std::to_string(part.open) + " scenes are open, " +
                       std::to_string(part.validation) + " for validation\n";
    if (part.enlarged > 0)
        text += "  " + std::to_string(part.enlarged) + " have fewer pixels than that and were enlarged\n";
    for (const auto& [reason, count] : part.left_out)
        text += "  " + std::to_string(count) + " left out: " + reason + "\n";
    if (!part.failures.empty())
        text += "  " + std::to_string(part.failures.size()) + " cannot be read\n";
    return text + "  licences:\n" + table(part.licences);
}

std::map<std::string, int> camera_licences(const PackCamerasIndex& cameras)
{
    std::map<std::string, int> licences;
    for (const std::vector<PackSpectrum>& list : { cameras.cameras, cameras.lights })
        for (const PackSpectrum& spectrum : list)
            ++licences[spectrum.licence];
    return licences;
}

int validation_count(const PackCamerasIndex& cameras)
{
    return int(std::count_if(cameras.cameras.begin(), cameras.cameras.end(),
                             [](const PackSpectrum& camera) { return camera.validation; }));
}

json part_json(const PartReport& part)
{
    return { { "size", part.size },         { "scenes", part.scenes },         { "images", part.images },
             { "open", part.open },         { "validation", part.validation }, { "enlarged", part.enlarged },
             { "licences", part.licences }, { "groups", part.groups },         { "left_out", part.left_out },
             { "failures", part.failures } };
}

} // namespace

std::string summary_text(const Summary& summary)
{
    std::string text = "pack '" + summary.pack + "'\n";
    if (summary.photos)
        text += part_text("photos", *summary.photos);
    if (summary.raws)
        text += part_text("raws", *summary.raws) + "  cameras:\n" + table(summary.raws->groups);
    if (summary.cameras)
        text += "cameras: " + std::to_string(summary.cameras->cameras.size()) + ", " +
                std::to_string(validation_count(*summary.cameras)) +
                " for validation; lights: " + std::to_string(summary.cameras->lights.size()) + "\n  licences:\n" +
                table(camera_licences(*summary.cameras));
    const auto note = [&](int count, const char* why) {
        if (count > 0)
            text += std::to_string(count) + " files left out: " + why + "\n";
    };
    note(summary.not_in_manifest, "not in manifest.csv");
    note(summary.not_open, "not open");
    note(summary.other_files, "no images");
    return text;
}

std::string summary_json(const Summary& summary)
{
    json object = { { "pack", summary.pack },
                    { "not_in_manifest", summary.not_in_manifest },
                    { "not_open", summary.not_open },
                    { "other_files", summary.other_files } };
    if (summary.photos)
        object["photos"] = part_json(*summary.photos);
    if (summary.raws)
        object["raws"] = part_json(*summary.raws);
    if (summary.cameras)
        object["cameras"] = { { "cameras", summary.cameras->cameras.size() },
                              { "validation", validation_count(*summary.cameras) },
                              { "lights", summary.cameras->lights.size() },
                              { "licences", camera_licences(*summary.cameras) } };
    return object.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

} // namespace srisp::tool
