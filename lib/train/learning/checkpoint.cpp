// SPDX-License-Identifier: Apache-2.0
#include "train/learning/checkpoint.h"

#include "base/input_file.h"
#include "base/json_text.h"
#include "base/shown_text.h"
#include "model/safetensors.h"

namespace srisp::train {

namespace {

const char kFormat[] = "srisp-checkpoint-1";
constexpr std::uint64_t kMaxBytes = 8ull << 30;
constexpr std::size_t kMaxTextBytes = std::size_t(64) << 20;

template<class Value> bool read_map(const std::string& text, std::map<std::string, Value>& map)
{
    const auto object = parse_json<nlohmann::json>(text, kMaxTextBytes);
    try {
        if (object)
            map = object->get<std::map<std::string, Value>>();
        return bool(object);
    } catch (const nlohmann::json::exception&) { // of another type
        return false;
    }
}

} // namespace

Status save_checkpoint(const TrainingState& state, const std::string& path)
{
    std::vector<torch::Tensor> kept; // alive until the file is written
    std::vector<TensorView> views;
    for (const auto& [name, tensor] : state.tensors) {
        kept.push_back(tensor.detach().to(torch::kCPU, torch::kFloat).contiguous());
        views.push_back({ name, "F32", kept.back().sizes().vec(), kept.back().data_ptr() });
    }
    return write_safetensors(path, views,
                             { { "format", kFormat },
                               { "numbers", nlohmann::json(state.numbers).dump() },
                               { "layout", state.layout },
                               { "texts", nlohmann::json(state.texts).dump() } });
}

Expected<TrainingState> load_checkpoint(const std::string& path)
{
    const std::string where = "checkpoint '" + path + "'";
    const Expected<std::string> bytes = read_file(path, kMaxBytes, where);
    if (!bytes)
        return bytes.error();
    Expected<SafeTensors> file = parse_safetensors(*bytes, where);
    if (!file)
        return file.error();
    auto& metadata = file->metadata;
    if (metadata["format"] != kFormat)
        return Error{ where + ": format is '" + shown_text(metadata["format"]) + "', this program reads '" + kFormat +
                      "'" };
    TrainingState state;
    if (!read_map(metadata["numbers"], state.numbers) || !read_map(metadata["texts"], state.texts))
        return Error{ where + ": metadata 'numbers' or 'texts' is broken" };
    for (const auto& [name, tensor] : file->tensors)
        state.tensors[name] = torch::tensor(tensor.values).reshape(tensor.shape);
    state.layout = metadata["layout"];
    return state;
}

} // namespace srisp::train
