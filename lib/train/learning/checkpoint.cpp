// SPDX-License-Identifier: Apache-2.0
#include "train/learning/checkpoint.h"

#include <nlohmann/json.hpp>

#include "model/safetensors.h"
#include "model/safetensors_writer.h"

namespace srisp::train {

namespace {

const char kFormat[] = "srisp-checkpoint-1";
constexpr std::uint64_t kMaxBytes = 8ull << 30;

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
        return Error{ where + ": format is '" + metadata["format"] + "', this program reads '" + kFormat + "'" };
    TrainingState state;
    try {
        state.numbers = nlohmann::json::parse(metadata["numbers"]).get<std::map<std::string, double>>();
        state.texts = nlohmann::json::parse(metadata["texts"]).get<std::map<std::string, std::string>>();
    } catch (const nlohmann::json::exception&) {
        return Error{ where + ": metadata 'numbers' or 'texts' is broken" };
    }
    for (const auto& [name, tensor] : file->tensors)
        state.tensors[name] = torch::tensor(tensor.values).reshape(tensor.shape);
    state.layout = metadata["layout"];
    return state;
}

} // namespace srisp::train
