// SPDX-License-Identifier: Apache-2.0
#include "linear_set.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <utility>

#include "base/file_part.h"
#include "base/half_float.h"
#include "base/input_file.h"
#include "base/shown_text.h"
#include "crops.h"
#include "model/safetensors.h"
#include "thumbnail/area_squasher.h"

namespace srisp::tool {

namespace {

const char kFormat[] = "srisp-thumbnails-1";

/// A set that is open; images are read one by one.
struct LinearSet {
    LinearSet(RegularFile opened, std::string name) : file(std::move(opened)), where(std::move(name)) {}

    RegularFile file;
    std::string where, camera, dataset, licence;
    std::string camera_prefix; ///< of names; empty: they tell no cameras
    std::vector<std::string> names;
    std::int64_t count = 0;
    int width = 0, height = 0;
    bool half = false;
    std::uint64_t raw = 0;         ///< where its bytes begin in the file
    std::vector<float> illuminant; ///< empty: not in the file
    std::vector<std::uint8_t> validation;

    Expected<std::vector<float>> image(std::int64_t index) const
    {
        std::vector<float> rgb(std::size_t(width) * height * 3);
        const std::size_t bytes = half ? sizeof(std::uint16_t) : sizeof(float);
        std::vector<std::uint16_t> halves(half ? rgb.size() : 0);
        const Status status = read_bytes(file, half ? static_cast<void*>(halves.data()) : rgb.data(),
                                         raw + std::size_t(index) * rgb.size() * bytes, rgb.size() * bytes);
        if (!status)
            return Error{ where + " " + status.error().message };
        std::transform(halves.begin(), halves.end(), rgb.begin(), float_from_half);
        return rgb;
    }
};

/// The tensor's values; none where there is no such tensor.
template<class Value> Expected<std::vector<Value>> find_tensor(const LinearSet& set, const SafeTensorsHeader& header,
                                                               const std::string& name, const std::string& type,
                                                               const std::vector<std::int64_t>& shape)
{
    for (const TensorEntry& entry : header.entries)
        if (entry.name == name) {
            if (entry.type != type || entry.shape != shape)
                return Error{ set.where + ": tensor '" + name + "' is " + entry.type + " " + shape_text(entry.shape) +
                              ", must be " + type + " " + shape_text(shape) };
            std::vector<Value> values((entry.end - entry.begin) / sizeof(Value));
            const Status status =
                read_bytes(set.file, values.data(), header.data_begin + entry.begin, values.size() * sizeof(Value));
            if (!status)
                return Error{ set.where + " " + status.error().message };
            return values;
        }
    return std::vector<Value>();
}

Status read_texts(LinearSet& set, const SafeTensorsHeader& header)
{
    const auto text = [&](const std::string& key) {
        const auto found = header.metadata.find(key);
        return found == header.metadata.end() ? std::string() : found->second;
    };
    if (text("format") != kFormat)
        return Error{ set.where + ": format is '" + shown_text(text("format")) + "', must be '" + kFormat + "'" };
    set.camera = text("camera");
    if (set.camera.empty())
        return Error{ set.where + ": metadata 'camera' is missing" };
    set.dataset = text("dataset");
    set.licence = text("licence");
    std::istringstream words(text("names"));
    for (std::string word; words >> word;)
        set.names.push_back(word);
    return {};
}

Status read_raw_shape(LinearSet& set, const SafeTensorsHeader& header)
{
    const auto raw = std::find_if(header.entries.begin(), header.entries.end(),
                                  [](const TensorEntry& entry) { return entry.name == "raw"; });
    if (raw == header.entries.end())
        return Error{ set.where + ": has no tensor 'raw'" };
    const std::vector<std::int64_t>& shape = raw->shape;
    if (shape.size() != 4 || shape[3] != 3 || std::min(shape[1], shape[2]) < kSmallestPackImage ||
        std::max(shape[1], shape[2]) > kLargestPackImage || raw->type == "U8")
        return Error{ set.where + ": tensor 'raw' is " + raw->type + " " + shape_text(shape) +
                      ", must be F16 or F32 [N, height, width, 3] with " + std::to_string(kSmallestPackImage) + " to " +
                      std::to_string(kLargestPackImage) + " pixels a side" };
    set.count = shape[0];
    set.height = int(shape[1]);
    set.width = int(shape[2]);
    set.half = raw->type == "F16";
    set.raw = header.data_begin + raw->begin;
    return {};
}

std::string prefix_of(const std::string& name)
{
    return name.substr(0, name.find('_'));
}

/// The set's camera as names of images begin with it; empty where none does.
std::string camera_prefix(const LinearSet& set)
{
    std::string joined = set.camera;
    joined.erase(std::remove(joined.begin(), joined.end(), ' '), joined.end());
    const bool used = std::any_of(set.names.begin(), set.names.end(),
                                  [&](const std::string& name) { return prefix_of(name) == joined; });
    return used ? joined : "";
}

Expected<std::shared_ptr<const LinearSet>> open_set(const std::string& path)
{
    const std::string where = "set '" + path + "'";
    Expected<RegularFile> file = open_for_parts(path);
    if (!file)
        return Error{ "set " + file.error().message };
    auto set = std::make_shared<LinearSet>(std::move(*file), where);
    const Expected<SafeTensorsHeader> header = read_safetensors_header(set->file, { "F16", "F32", "U8" }, set->where);
    if (!header)
        return header.error();
    for (const Status& status : { read_texts(*set, *header), read_raw_shape(*set, *header) })
        if (!status)
            return status.error();
    auto illuminant = find_tensor<float>(*set, *header, "illuminant", "F32", { set->count, 3 });
    auto validation = find_tensor<std::uint8_t>(*set, *header, "validation", "U8", { set->count });
    if (!illuminant || !validation)
        return !illuminant ? illuminant.error() : validation.error();
    set->illuminant = std::move(*illuminant);
    set->validation = std::move(*validation);
    if (!set->names.empty() && std::int64_t(set->names.size()) != set->count)
        return Error{ set->where + ": metadata 'names' has " + std::to_string(set->names.size()) +
                      " words, the set has " + std::to_string(set->count) + " images" };
    set->camera_prefix = camera_prefix(*set);
    return std::shared_ptr<const LinearSet>(set);
}

/// Sets may hold images of a second camera; then their names begin with the cameras' ("NikonD40_0001" in a set of the
/// Nikon D5200).
std::string camera_of(const LinearSet& set, std::int64_t index)
{
    if (set.camera_prefix.empty() || prefix_of(set.names[index]) == set.camera_prefix)
        return set.camera;
    const std::string prefix = prefix_of(set.names[index]), make = set.camera.substr(0, set.camera.find(' '));
    return prefix.compare(0, make.size(), make) == 0 ? make + " " + prefix.substr(make.size()) : prefix;
}

void set_white_balance(const LinearSet& set, std::int64_t index, PackEntry& image)
{
    if (set.illuminant.empty())
        return;
    const float* light = set.illuminant.data() + 3 * index;
    if (std::all_of(light, light + 3, [](float v) { return v > 0 && std::isfinite(v); }))
        image.white_balance = { light[1] / light[0], 1, light[1] / light[2] };
}

/// Cuts the crops out of the part that is not masked.
void squash_crops(const LinearSet& set, const std::vector<float>& rgb, const Roi& part, const CropSettings& settings,
                  PackedScene& packed)
{
    const int width = part.x1 - part.x0, height = part.y1 - part.y0;
    for (Roi crop :
         choose_crops(width, height, settings.size, settings.crops, settings.seed, packed.scene.common.name)) {
        crop = { crop.x0 + part.x0, crop.x1 + part.x0, crop.y0 + part.y0, crop.y1 + part.y0 };
        AreaSquasher squasher(crop.x1 - crop.x0, crop.y1 - crop.y0, settings.size);
        const std::ptrdiff_t row = std::ptrdiff_t(3) * set.width;
        squasher.add_rows({ rgb.data() + crop.y0 * row + 3 * crop.x0, crop.x1 - crop.x0, crop.y1 - crop.y0, 3, row });
        append_pixels(squasher.finish(1), packed.pixels);
        packed.scene.crops.push_back(relative_crop(crop, set.width, set.height));
    }
    packed.enlarged = std::min(width, height) < settings.size;
}

Expected<PackedScene> pack_image(const LinearSet& set, std::int64_t index, const std::string& name,
                                 const Provenance& provenance, const CropSettings& settings)
{
    const Expected<std::vector<float>> read = set.image(index);
    if (!read)
        return read.error();
    const std::vector<float>& rgb = *read;
    if (!std::all_of(rgb.begin(), rgb.end(), [](float v) { return std::isfinite(v); }))
        return Error{ set.where + ": image " + std::to_string(index) + " holds NaN or infinity" };
    PackedScene packed;
    PackEntry& image = packed.scene.common;
    image.name = name;
    image.group = camera_of(set, index);
    image.source = provenance.source;
    image.licence = provenance.licence;
    image.open = provenance.open;
    image.validation = !set.validation.empty() ? set.validation[std::size_t(index)] != 0 : provenance.validation;
    set_white_balance(set, index, image);
    const Roi part = largest_unmasked_part(rgb, set.width, set.height);
    if ((part.x1 - part.x0) * (part.y1 - part.y0) * 2 < set.width * set.height)
        packed.left_out = "less than half of the image is not masked with zeros";
    else
        squash_crops(set, rgb, part, settings, packed);
    return packed;
}

} // namespace

int linear_set_size(const std::string& path)
{
    const auto set = open_set(path);
    return set ? std::min((*set)->width, (*set)->height) : 0;
}

std::vector<PackTask> linear_set_tasks(const std::string& path, const std::string& name, const Provenance& provenance,
                                       const CropSettings& settings)
{
    const auto opened = open_set(path);
    if (!opened)
        return { { path, [error = opened.error()]() -> Expected<PackedScene> { return error; } } };
    const std::shared_ptr<const LinearSet> set = *opened;
    Provenance stated = provenance;
    const auto state = [](std::string& text, const std::string& own) {
        if (text == Provenance().licence && !own.empty())
            text = own;
    };
    state(stated.source, set->dataset);
    state(stated.licence, set->licence);
    std::vector<PackTask> tasks;
    for (std::int64_t i = 0; i < set->count; ++i) {
        const std::string image = name + "/" + (set->names.empty() ? std::to_string(i) : set->names[i]);
        tasks.push_back({ image, [=] { return pack_image(*set, i, image, stated, settings); } });
    }
    return tasks;
}

} // namespace srisp::tool
