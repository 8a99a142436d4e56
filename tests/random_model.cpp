// SPDX-License-Identifier: Apache-2.0
#include "random_model.h"

#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

#include "base/half_float.h"

using srisp::Tensor;

namespace {

void append(std::string& bytes, const std::vector<float>& values, const std::string& type)
{
    const char* const raw = reinterpret_cast<const char*>(values.data());
    if (type == "F32") {
        bytes.append(raw, 4 * values.size());
    } else if (type == "BF16") {
        for (std::size_t i = 0; i < values.size(); ++i)
            bytes.append(raw + 4 * i + 2, 2); // truncated: exact enough for a test model
    } else {
        for (const float value : values) {
            const std::uint16_t bits = srisp::half_from_float(value);
            bytes.append(reinterpret_cast<const char*>(&bits), 2);
        }
    }
}

Tensor random_tensor(Random& random, const std::vector<std::int64_t>& shape, float low, float high)
{
    std::int64_t count = 1;
    for (const std::int64_t extent : shape)
        count *= extent;
    Tensor tensor{ shape, std::vector<float>(count) };
    for (float& value : tensor.values)
        value = random.uniform(low, high);
    return tensor;
}

/// weight and bias of a layer, scaled so that values neither vanish nor grow through it.
void add_layer(ModelFile& model, Random& random, const std::string& name, std::vector<std::int64_t> weight, bool atoms)
{
    std::int64_t inputs = 1;
    for (std::size_t i = atoms ? 2 : 1; i < weight.size(); ++i)
        inputs *= weight[i];
    const float scale = std::sqrt(3.0f / static_cast<float>(inputs));
    model.tensors[name + ".weight"] = random_tensor(random, weight, -scale, scale);
    weight.resize(atoms ? 2 : 1);
    model.tensors[name + ".bias"] = random_tensor(random, weight, -0.1f, 0.1f);
}

void add_encoder(ModelFile& model, Random& random, const std::string& name, const std::vector<std::int64_t>& channels)
{
    for (std::size_t l = 0; l + 1 < channels.size(); ++l)
        add_layer(model, random, name + "." + std::to_string(l), { channels[l + 1], channels[l], 3, 3 }, false);
}

void add_blocks(ModelFile& model, Random& random, int atoms)
{
    for (const std::string block : { "tone", "gamma", "color", "white_balance", "gain" }) {
        const bool tone = block == "tone";
        add_encoder(model, random, block + ".encoder", { tone ? 3 : 3 * atoms, 32, 32, 32, 32 });
        for (int l = 0; l < (tone ? 4 : 1); ++l) {
            const std::string suffix = tone ? "." + std::to_string(l) : "";
            add_layer(model, random, block + ".project" + suffix, { 32, 128 }, false);
            add_layer(model, random, block + ".head" + suffix, { atoms, 32 }, false);
        }
    }
}

void add_dictionaries(ModelFile& model, Random& random, int atoms, int kernel)
{
    model.tensors["dictionary.gain"] = random_tensor(random, { atoms }, 0.5f, 2);
    model.tensors["dictionary.gamma"] = random_tensor(random, { atoms }, 1.8f, 2.6f);
    model.tensors["dictionary.white_balance"] = random_tensor(random, { atoms, 2 }, 0.7f, 1.5f);
    Tensor color = random_tensor(random, { atoms, 3, 3 }, -0.3f, 0.1f);
    for (int atom = 0; atom < atoms; ++atom)
        for (int d = 0; d < 3; ++d)
            color.values[atom * 9 + d * 4] = 1.5f;
    model.tensors["dictionary.color"] = color;
    const std::int64_t channels[] = { 3, 32, 32, 32, 3 };
    for (const std::string direction : { "tone_reverse", "tone_forward" })
        for (int l = 0; l < 4; ++l)
            add_layer(model, random, "dictionary." + direction + "." + std::to_string(l),
                      { atoms, channels[l + 1], channels[l], kernel, kernel }, true);
}

} // namespace

std::vector<float> random_values(Random& random, std::size_t count)
{
    std::vector<float> values(count);
    for (float& value : values)
        value = random.uniform(-1, 1);
    return values;
}

ModelFile random_model(int kernel_size, std::uint64_t seed, int dictionary_size)
{
    Random random(seed);
    ModelFile model;
    model.metadata = { { "format", "srisp-1" },
                       { "kernel_size", std::to_string(kernel_size) },
                       { "dictionary_size", std::to_string(dictionary_size) },
                       { "encoder_input", "perceptual" },
                       { "statistics", "12" },
                       { "anchor", "1" },
                       { "train_data", "none: random values for tests" },
                       { "license", "Apache-2.0" } };
    add_encoder(model, random, "source_encoder", { 3, 32, 64, 128, 128, 128 });
    add_encoder(model, random, "reference_encoder", { 3, 32, 64, 128, 128, 128 });
    add_layer(model, random, "source_statistics", { 128, 12 }, false);
    add_layer(model, random, "reference_statistics", { 128, 12 }, false);
    add_layer(model, random, "anchor", { 3, 24 }, false);
    add_layer(model, random, "fuse", { 128, 256 }, false);
    add_blocks(model, random, dictionary_size);
    add_dictionaries(model, random, dictionary_size, kernel_size);
    return model;
}

ModelFile random_srisp_7_model(int kernel_size, std::uint64_t seed, int selection_size, double brightness_sd_ev)
{
    ModelFile model = random_model(kernel_size, seed);
    Random random(seed + 1);
    model.metadata["format"] = "srisp-7";
    model.metadata["selection_size"] = std::to_string(selection_size);
    const std::int64_t widths[] = { 217, 256, 256, 256, 3 };
    for (int l = 0; l < 4; ++l)
        add_layer(model, random, "anchor_network." + std::to_string(l), { widths[l + 1], widths[l] }, false);
    for (float& weight : model.tensors["anchor_network.3.weight"].values)
        weight *= 0.1f;
    add_layer(model, random, "anchor_deviation.0", { 32, 256 }, false);
    model.tensors["anchor_deviation.1.weight"] = { { 1, 32 }, std::vector<float>(32) };
    model.tensors["anchor_deviation.1.bias"] = { { 1 }, { float(std::log(brightness_sd_ev * std::log(2.0))) } };
    return model;
}

std::string ModelFile::bytes() const
{
    nlohmann::json header;
    header["__metadata__"] = metadata;
    std::string data;
    for (const auto& [name, tensor] : tensors) {
        const std::size_t begin = data.size();
        append(data, tensor.values, type);
        header[name] = { { "dtype", type }, { "shape", tensor.shape }, { "data_offsets", { begin, data.size() } } };
    }
    const std::string text = header.dump();
    const std::uint64_t length = text.size();
    return std::string(reinterpret_cast<const char*>(&length), 8) + text + data;
}

std::string ModelFile::write(const std::string& path) const
{
    write_file(path, bytes());
    return path;
}

void write_file(const std::string& path, const std::string& bytes)
{
    std::ofstream(path, std::ios::binary) << bytes;
}
