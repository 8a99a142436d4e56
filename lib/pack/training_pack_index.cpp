// SPDX-License-Identifier: Apache-2.0
#include "pack/training_pack_index.h"

#include <algorithm>

#include "base/json_object.h"
#include "base/near_names.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

using nlohmann::json;

json json_of_file(const PackFile& file)
{
    return { { "file", file.name }, { "bytes", file.bytes }, { "hash", file.hash } };
}

json json_of_scene(const PackScene& scene)
{
    const PackEntry& image = scene.common;
    json object = { { "name", image.name },       { "group", image.group }, { "source", image.source },
                    { "licence", image.licence }, { "open", image.open },   { "validation", image.validation },
                    { "crops", scene.crops } };
    if (image.white_balance[1] > 0)
        object["white_balance"] = image.white_balance;
    if (image.color[0] != 0)
        object["color"] = image.color;
    return object;
}

json json_of_images(const PackImagesIndex& images)
{
    json object = json_of_file(images.file);
    object["size"] = images.size;
    object["images"] = json::array();
    for (const PackScene& scene : images.scenes)
        object["images"].push_back(json_of_scene(scene));
    return object;
}

json json_of_cameras(const PackCamerasIndex& index)
{
    json object = json_of_file(index.file);
    object["cameras"] = object["lights"] = json::array();
    for (const PackSpectrum& camera : index.cameras)
        object["cameras"].push_back({ { "name", camera.name },
                                      { "source", camera.source },
                                      { "licence", camera.licence },
                                      { "validation", camera.validation } });
    for (const PackSpectrum& light : index.lights)
        object["lights"].push_back({ { "name", light.name },
                                     { "kind", light.kind },
                                     { "source", light.source },
                                     { "licence", light.licence } });
    return object;
}

/// JsonObjectReader, and what only a pack holds.
class PackReader : public JsonObjectReader {
public:
    using JsonObjectReader::JsonObjectReader;

    std::uint64_t take_count(const std::string& key, std::uint64_t low, std::uint64_t high)
    {
        const json& value = take(key);
        if (value.is_number_unsigned() && value.get<std::uint64_t>() >= low && value.get<std::uint64_t>() <= high)
            return value.get<std::uint64_t>();
        fail("'" + key + "' is " + shown_json(value) + ", must be a whole number from " + std::to_string(low) + " to " +
             std::to_string(high));
        return low;
    }

    bool take_flag(const std::string& key)
    {
        const json& value = take(key);
        if (!value.is_boolean())
            fail("'" + key + "' must be true or false");
        return value.is_boolean() && value.get<bool>();
    }

    PackFile take_file()
    {
        PackFile file;
        file.name = take_text("file");
        file.bytes = take_count("bytes", 1, std::uint64_t(1) << 50);
        file.hash = take_text("hash");
        if (file.name.empty() || file.name[0] == '.' || file.name.find('/') != std::string::npos)
            fail("'file' is '" + shown_text(file.name) + "', must be the name of a file in the pack");
        return file;
    }

    template<std::size_t N> std::array<float, N> take_array(const std::string& key)
    {
        std::array<float, N> array{};
        const std::vector<float> list = take_list(key);
        if (list.size() == N)
            std::copy(list.begin(), list.end(), array.begin());
        else
            fail("'" + key + "' has " + std::to_string(list.size()) + " numbers, needs " + std::to_string(N));
        return array;
    }

    /// Each element of a list, read by `read`, which returns a Status.
    template<class Read> void each(const std::string& key, Read read)
    {
        const json& list = take(key);
        if (!list.is_array())
            return fail("'" + key + "' must be a list");
        for (const json& element : list)
            if (Status status = read(element); !status)
                return fail("'" + key + "': " + status.error().message);
    }
};

std::vector<std::array<float, 4>> take_crops(PackReader& reader, const json& object)
{
    std::vector<std::array<float, 4>> crops;
    const auto list = object.find("crops");
    const bool is_list = list != object.end() && list->is_array();
    for (const std::vector<float>& crop : reader.take_lists("crops", is_list ? list->size() : 1)) {
        if (crop.size() != 4 || !(crop[0] >= 0 && crop[0] < crop[2] && crop[2] <= 1) ||
            !(crop[1] >= 0 && crop[1] < crop[3] && crop[3] <= 1))
            reader.fail("'crops' must be lists of left < right, top < bottom (0 … 1), in the order left, top, right, "
                        "bottom");
        else
            crops.push_back({ crop[0], crop[1], crop[2], crop[3] });
    }
    if (crops.empty())
        reader.fail("'crops' is empty");
    return crops;
}

Status read_scene(const json& object, std::size_t index, std::vector<PackScene>& scenes)
{
    PackReader reader(object, "image " + std::to_string(index));
    if (!object.is_object())
        return reader.finish();
    PackScene scene;
    PackEntry& image = scene.common;
    image.name = reader.take_text("name");
    image.group = reader.take_text("group");
    image.source = reader.take_text("source");
    image.licence = reader.take_text("licence");
    image.open = reader.take_flag("open");
    image.validation = reader.take_flag("validation");
    scene.crops = take_crops(reader, object);
    if (object.contains("white_balance")) {
        image.white_balance = reader.take_array<3>("white_balance");
        if (!std::all_of(image.white_balance.begin(), image.white_balance.end(), [](float gain) { return gain > 0; }))
            reader.fail("'white_balance' must be above 0");
    }
    if (object.contains("color"))
        image.color = reader.take_array<9>("color");
    scenes.push_back(std::move(scene));
    return reader.finish();
}

Expected<PackImagesIndex> read_images(const json& object, const std::string& where)
{
    PackReader reader(object, where);
    PackImagesIndex images;
    images.file = reader.take_file();
    images.size = int(reader.take_count("size", kSmallestPackImage, kLargestPackImage));
    reader.each("images", [&](const json& scene) { return read_scene(scene, images.scenes.size(), images.scenes); });
    if (images.scenes.empty())
        reader.fail("holds no images");
    if (Status status = reader.finish(); !status)
        return status.error();
    return images;
}

Expected<PackCamerasIndex> read_cameras(const json& object, const std::string& where)
{
    PackReader reader(object, where);
    PackCamerasIndex index;
    index.file = reader.take_file();
    const auto read = [](const json& element, bool camera, std::vector<PackSpectrum>& list) {
        PackReader spectrum(element, (camera ? "camera " : "light ") + std::to_string(list.size()));
        if (!element.is_object())
            return spectrum.finish();
        PackSpectrum result{ spectrum.take_text("name"), "", spectrum.take_text("source"),
                             spectrum.take_text("licence") };
        if (camera)
            result.validation = spectrum.take_flag("validation");
        else
            result.kind = spectrum.take_text("kind");
        const std::vector<std::string>& kinds = pack_light_kinds();
        if (!camera && std::find(kinds.begin(), kinds.end(), result.kind) == kinds.end())
            spectrum.fail("has kind '" + shown_text(result.kind) + "'" + near_names(result.kind, kinds));
        list.push_back(std::move(result));
        return spectrum.finish();
    };
    reader.each("cameras", [&](const json& camera) { return read(camera, true, index.cameras); });
    reader.each("lights", [&](const json& light) { return read(light, false, index.lights); });
    if (index.cameras.empty() || index.lights.empty())
        reader.fail("holds no cameras or no lights");
    if (Status status = reader.finish(); !status)
        return status.error();
    return index;
}

/// Reads a part that a pack may lack.
template<class Part, class Read>
Status read_part(PackReader& pack, const json& object, const std::string& key, std::optional<Part>& part, Read read)
{
    if (!object.contains(key))
        return {};
    auto result = read(pack.take(key), "'" + key + "'");
    if (!result)
        return result.error();
    part = std::move(*result);
    return {};
}

} // namespace

const std::vector<std::string>& pack_light_kinds()
{
    static const std::vector<std::string> kinds = { "daylight", "tungsten", "fluorescent", "led" };
    return kinds;
}

std::string format_pack_index(const PackIndex& index)
{
    json pack = { { "format", kPackFormat }, { "made_by", index.made_by }, { "settings", index.settings } };
    if (index.photos)
        pack["photos"] = json_of_images(*index.photos);
    if (index.raws)
        pack["raws"] = json_of_images(*index.raws);
    if (index.cameras)
        pack["cameras"] = json_of_cameras(*index.cameras);
    return pack.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

Expected<PackIndex> parse_pack_index(const std::string& text, const std::string& where)
{
    const Expected<json> parsed = parse_json_object(text, where, kPackIndexName, kMaxPackIndexBytes);
    if (!parsed)
        return parsed.error();
    const std::string inside = where + ": " + kPackIndexName;
    PackReader pack(*parsed, inside + ":");
    PackIndex index;
    const std::string format = pack.take_text("format");
    if (format != kPackFormat)
        pack.fail("format is '" + shown_text(format) + "', this program reads '" + kPackFormat + "'");
    index.made_by = pack.take_text("made_by");
    index.settings = pack.take("settings");
    for (const Status& status : { read_part(pack, *parsed, "photos", index.photos, read_images),
                                  read_part(pack, *parsed, "raws", index.raws, read_images),
                                  read_part(pack, *parsed, "cameras", index.cameras, read_cameras) })
        if (!status)
            pack.fail(status.error().message);
    if (Status status = pack.finish(); !status)
        return status.error();
    if (!index.photos && !index.raws && !index.cameras)
        return Error{ inside + ": the pack is empty (no photos, raws or cameras)" };
    return index;
}

std::vector<PackEntry> pack_entries(const PackImagesIndex& index)
{
    std::vector<PackEntry> entries;
    for (std::size_t scene = 0; scene < index.scenes.size(); ++scene)
        for (const std::array<float, 4>& crop : index.scenes[scene].crops) {
            entries.push_back(index.scenes[scene].common);
            entries.back().scene = int(scene);
            entries.back().crop = crop;
        }
    return entries;
}

} // namespace srisp
