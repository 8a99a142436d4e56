// SPDX-License-Identifier: Apache-2.0
#include "train/evaluation/developed_images.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "base/input_file.h"
#include "base/json_text.h"
#include "model/safetensors.h"

namespace srisp::train {

namespace {

constexpr std::uint64_t kMaxBytes = std::uint64_t(1) << 31;
const std::string kPhoto = "photo:";

/// The names in metadata `cameras`, one for each image; empty where they are not that.
std::vector<std::string> camera_names(const SafeTensors& file)
{
    const auto text = file.metadata.find("cameras");
    const auto names =
        text == file.metadata.end() ? Expected<nlohmann::json>(nullptr) : parse_json<nlohmann::json>(text->second);
    std::vector<std::string> result;
    if (names && names->is_array())
        for (const nlohmann::json& name : *names)
            result.push_back(name.is_string() ? name.get<std::string>() : "");
    return result;
}

} // namespace

Expected<DevelopedImages> read_developed_images(const std::string& path)
{
    const std::string where = "developed images '" + path + "'";
    Expected<std::string> bytes = read_file(path, kMaxBytes, where);
    if (!bytes)
        return bytes.error();
    Expected<SafeTensors> file = parse_safetensors(*bytes, where);
    if (!file)
        return file.error();
    const auto format = file->metadata.find("format");
    if (format == file->metadata.end() || format->second != "srisp-developed-1")
        return Error{ where + ": metadata 'format' must be 'srisp-developed-1'" };
    const auto raw = file->tensors.find("raw");
    if (raw == file->tensors.end())
        return Error{ where + ": has no tensor 'raw'" };
    const std::vector<std::int64_t> shape = raw->second.shape;
    if (shape.size() != 4 || shape[0] < 1 || shape[1] != 3 || shape[2] < 2 || shape[3] < 2)
        return Error{ where + ": tensor 'raw' has shape " + shape_text(shape) + ", needs [N, 3, height, width]" };

    DevelopedImages result;
    result.scenes.set = "developed";
    for (const std::string& name : camera_names(*file)) {
        std::vector<std::string>& known = result.scenes.cameras;
        const auto found = std::find(known.begin(), known.end(), name);
        result.scenes.camera.push_back(static_cast<int>(found - known.begin()));
        if (found == known.end())
            known.push_back(name);
    }
    if (result.scenes.camera.size() != static_cast<std::size_t>(shape[0]))
        return Error{ where + ": metadata 'cameras' has " + std::to_string(result.scenes.camera.size()) +
                      " names, needs " + std::to_string(shape[0]) + ", one for each image" };
    for (auto& [name, tensor] : file->tensors) {
        if (tensor.shape != shape)
            return Error{ where + ": tensor '" + name + "' has shape " + shape_text(tensor.shape) + ", needs " +
                          shape_text(shape) + ", that of 'raw'" };
        const auto values = torch::tensor(tensor.values).view(shape);
        if (!values.ge(0).logical_and(values.le(1)).all().item<bool>())
            return Error{ where + ": tensor '" + name + "' has values outside 0 … 1" };
        if (name == "raw")
            result.scenes.raw = values;
        else if (name.compare(0, kPhoto.size(), kPhoto) == 0)
            result.photos.emplace_back(name.substr(kPhoto.size()), values);
        else
            return Error{ where + ": unknown tensor '" + name + "'" };
    }
    if (result.photos.empty())
        return Error{ where + ": has no tensor 'photo:…'" };
    return result;
}

} // namespace srisp::train
