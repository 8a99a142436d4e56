// SPDX-License-Identifier: Apache-2.0
#include "train/run/model_file.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "base/half_float.h"
#include "base/input_file.h"
#include "base/json_text.h"
#include "model/model_data.h"
#include "model/safetensors.h"
#include "train/baselines/baselines.h"
#include "train/network/network.h"
#include "train/settings/settings.h"

namespace srisp::train {

namespace {

constexpr std::uint64_t kMaxModelBytes = 1 << 28;
constexpr char kBaselineFormat[] = "srisp-baseline-1";

using Named = std::map<std::string, torch::Tensor>;

/// Parameters in float32 on the CPU.
Named parameters_of(const Unprocessor& model)
{
    Named result;
    for (const auto& item : model.named_parameters())
        result[item.key()] = item.value().detach().to(torch::kCPU, torch::kFloat32).contiguous();
    return result;
}

/// The settings of the full model that computes the same as this one.
ModelSettings full_settings(const ModelSettings& settings)
{
    ModelSettings full = settings.resolved();
    full.method = "srisp";
    full.selection = full.tone = full.gamma = "dynamic";
    full.statistics = settings.resolved().statistics || settings.resolved().anchor;
    return full;
}

/// A selection that does not look at the images has zeros where it would look at them; its logits are the biases of
/// the heads.
Named with_missing_parts(Named parameters, const ModelSettings& settings)
{
    for (const auto& item : Network(full_settings(settings), 0).named_parameters())
        if (!parameters.count(item.key()))
            parameters[item.key()] = torch::zeros(item.value().sizes());
    return parameters;
}

void describe_model(const ModelSettings& settings, std::map<std::string, std::string>& metadata)
{
    const ModelSettings full = full_settings(settings);
    metadata["format"] = full.anchor_network ? "srisp-7" : "srisp-1";
    if (full.anchor_network)
        metadata["selection_size"] = std::to_string(full.selection_size);
    metadata["kernel_size"] = full.kernel_size;
    metadata["dictionary_size"] = std::to_string(full.dictionary_size);
    metadata["encoder_input"] = full.encoder_input;
    metadata["statistics"] = full.statistics ? "12" : "0";
    metadata["anchor"] = full.anchor ? "1" : "0";
}

void describe_baseline(ModelSettings settings, std::map<std::string, std::string>& metadata)
{
    SettingsWriter writer;
    settings.describe(writer);
    metadata["format"] = kBaselineFormat;
    metadata["settings"] = writer.object().dump();
}

/// The values of a tensor in the type in which they are written.
Expected<std::string> encoded(const torch::Tensor& tensor, bool half, const std::string& where)
{
    const float* const values = tensor.data_ptr<float>();
    const std::int64_t count = tensor.numel();
    std::string bytes(static_cast<std::size_t>(count) * (half ? 2 : 4), '\0');
    for (std::int64_t i = 0; i < count; ++i) {
        const std::uint16_t rounded = half_from_float(values[i]);
        if (!std::isfinite(half ? float_from_half(rounded) : values[i]))
            return Error{ where + " has " + std::to_string(values[i]) + " at element " + std::to_string(i) +
                          (half ? ", largest float16 is 65504" : "") };
        if (half)
            std::memcpy(&bytes[i * 2], &rounded, 2);
        else
            std::memcpy(&bytes[i * 4], &values[i], 4);
    }
    return bytes;
}

Status copy_parameters(Unprocessor& model, const std::map<std::string, Tensor>& tensors, const std::string& where)
{
    const torch::NoGradGuard no_gradient;
    const auto parameters = model.named_parameters();
    if (parameters.size() != tensors.size())
        return Error{ where + ": has " + std::to_string(tensors.size()) + " tensors, needs " +
                      std::to_string(parameters.size()) };
    for (const auto& item : parameters) {
        const auto found = tensors.find(item.key());
        if (found == tensors.end())
            return Error{ where + ": has no tensor '" + item.key() + "'" };
        const Tensor& tensor = found->second;
        if (tensor.shape != item.value().sizes().vec())
            return Error{ where + ": tensor '" + item.key() + "' has shape " + shape_text(tensor.shape) + ", needs " +
                          shape_text(item.value().sizes().vec()) };
        item.value().copy_(torch::tensor(tensor.values).view(tensor.shape));
    }
    return {};
}

ModelSettings settings_of(const ModelData& data)
{
    ModelSettings settings;
    settings.kernel_size = std::to_string(data.kernel_size);
    settings.dictionary_size = data.dictionary_size;
    settings.encoder_input = data.perceptual_encoder_input ? "perceptual" : "plain";
    settings.statistics = data.source_statistics.has_value();
    settings.anchor = data.anchor.has_value();
    settings.anchor_network = !data.anchor_network.empty();
    settings.selection_size = data.selection_size;
    settings.white_stays_white = data.white_stays_white;
    return settings;
}

Expected<ModelSettings> baseline_settings(const std::map<std::string, std::string>& metadata, const std::string& where)
{
    const auto text = metadata.find("settings");
    const auto object =
        text == metadata.end() ? Expected<nlohmann::json>(nullptr) : parse_json<nlohmann::json>(text->second);
    if (!object || !object->is_object())
        return Error{ where + ": metadata 'settings' is missing or no JSON object" };
    ModelSettings settings;
    SettingsReader reader(*object, where + ": metadata 'settings'");
    settings.describe(reader);
    if (Status status = reader.finish(); !status)
        return status.error();
    return settings;
}

} // namespace

std::shared_ptr<Unprocessor> make_unprocessor(const ModelSettings& settings, std::uint64_t seed)
{
    if (settings.method == "gain_match")
        return std::make_shared<GainMatch>();
    if (settings.method == "upi")
        return std::make_shared<Upi>(seed);
    if (settings.method == "unet")
        return std::make_shared<UNet>(settings.unet_channels, seed);
    return std::make_shared<Network>(settings, seed);
}

bool is_srisp_model(const ModelSettings& settings)
{
    const ModelSettings resolved = settings.resolved();
    return (settings.method == "srisp" || settings.method == "mbispld") && resolved.gain == "separate";
}

Status save_model(const Unprocessor& model, const ModelSettings& settings, const std::string& path,
                  std::map<std::string, std::string> metadata, const std::string& type, double deviation_factor)
{
    const std::string where = "model '" + path + "'";
    for (const char* key : { "train_data", "license" })
        if (!metadata.count(key))
            return Error{ where + ": metadata '" + key + "' is missing" };
    Named parameters = parameters_of(model);
    if (const auto told = parameters.find("anchor_deviation.1.bias"); told != parameters.end())
        told->second = told->second + std::log(deviation_factor);
    if (is_srisp_model(settings)) {
        parameters = with_missing_parts(std::move(parameters), settings);
        describe_model(settings, metadata);
    } else {
        describe_baseline(settings, metadata);
    }
    std::vector<TensorView> views;
    std::vector<std::string> values;
    values.reserve(parameters.size());
    for (const auto& [name, tensor] : parameters) {
        Expected<std::string> bytes = encoded(tensor, type == "F16", where + ": tensor '" + name + "'");
        if (!bytes)
            return bytes.error();
        values.push_back(std::move(*bytes));
        views.push_back({ name, type, tensor.sizes().vec(), values.back().data() });
    }
    return write_safetensors(path, std::move(views), metadata);
}

Expected<LoadedModel> load_model(const std::string& path)
{
    const std::string where = "model '" + path + "'";
    Expected<std::string> bytes = read_file(path, kMaxModelBytes, where);
    if (!bytes)
        return bytes.error();
    Expected<SafeTensors> file = parse_safetensors(*bytes, where);
    if (!file)
        return file.error();
    LoadedModel loaded;
    loaded.metadata = file->metadata;
    const auto format = file->metadata.find("format");
    if (format != file->metadata.end() && format->second == kBaselineFormat) {
        Expected<ModelSettings> settings = baseline_settings(file->metadata, where);
        if (!settings)
            return settings.error();
        loaded.settings = *settings;
    } else {
        Expected<std::unique_ptr<ModelData>> data = parse_model(*bytes, where);
        if (!data)
            return data.error();
        loaded.settings = settings_of(**data);
    }
    loaded.model = make_unprocessor(loaded.settings, 0);
    if (Status status = copy_parameters(*loaded.model, file->tensors, where); !status)
        return status.error();
    return loaded;
}

} // namespace srisp::train
