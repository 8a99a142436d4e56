// SPDX-License-Identifier: Apache-2.0
#include "model/model_data.h"

#include <algorithm>
#include <cmath>

#include "base/near_names.h"
#include "base/shown_text.h"
#include "features/image_features.h"
#include "features/match_features.h"
#include "model/safetensors.h"

namespace srisp {

namespace {

constexpr int kMaxDictionarySize = 64;

/// From [outputs, in, 3, 3] to [outputs / kEncoderGroup, 3, 3, in, kEncoderGroup].
std::vector<float> side_by_side(const std::vector<float>& weight, int in)
{
    std::vector<float> result(weight.size());
    for (std::size_t i = 0; i < weight.size(); ++i) { // what could not be taken is empty
        const std::size_t tap = i % 9, input = i / 9 % in, output = i / 9 / in;
        result[((output / kEncoderGroup * 9 + tap) * in + input) * kEncoderGroup + output % kEncoderGroup] = weight[i];
    }
    return result;
}

/// Takes tensors out of a file by name and shape. The first error stays; what follows it does nothing.
class TensorTaker {
public:
    TensorTaker(SafeTensors file, std::string where) : m_file(std::move(file)), m_where(std::move(where)) {}

    std::vector<float> take(const std::string& name, const std::vector<std::int64_t>& shape)
    {
        if (!m_error.empty())
            return {};
        m_taken.push_back(name);
        const auto found = m_file.tensors.find(name);
        if (found == m_file.tensors.end())
            return fail("has no tensor '" + name + "'");
        Tensor tensor = std::move(found->second);
        m_file.tensors.erase(found);
        if (tensor.shape != shape)
            return fail("tensor '" + name + "' has shape " + shape_text(tensor.shape) + ", needs " + shape_text(shape));
        const auto bad =
            std::find_if(tensor.values.begin(), tensor.values.end(), [](float v) { return !std::isfinite(v); });
        if (bad != tensor.values.end())
            return fail("tensor '" + name + "' has " + std::to_string(*bad) + " at element " +
                        std::to_string(bad - tensor.values.begin()));
        return std::move(tensor.values);
    }

    DenseLayer take_dense(const std::string& name, int outputs, int inputs)
    {
        return { inputs, outputs, take(name + ".weight", { outputs, inputs }), take(name + ".bias", { outputs }) };
    }

    /// `channels`: of the input and after each layer; 3×3 kernels.
    EncoderWeights take_encoder(const std::string& name, const std::vector<int>& channels)
    {
        EncoderWeights layers;
        for (std::size_t l = 0; l + 1 < channels.size(); ++l) {
            const std::string layer = name + "." + std::to_string(l);
            const int in = channels[l], out = channels[l + 1];
            layers.push_back({ in, out, side_by_side(take(layer + ".weight", { out, in, 3, 3 }), in),
                               take(layer + ".bias", { out }) });
        }
        return layers;
    }

    std::vector<float> fail(const std::string& reason)
    {
        if (m_error.empty())
            m_error = m_where + ": " + reason;
        return {};
    }

    /// What must be so once everything was taken: no tensor is left over.
    Status finish()
    {
        if (m_error.empty() && !m_file.tensors.empty()) {
            const std::string& name = m_file.tensors.begin()->first;
            fail("unknown tensor '" + shown_text(name) + "'" + near_names(name, m_taken));
        }
        return m_error.empty() ? Status() : Status(Error{ m_error });
    }

private:
    SafeTensors m_file;
    std::string m_where, m_error;
    std::vector<std::string> m_taken;
};

/// Reads the settings in `__metadata__`; an error says which is missing or impossible.
class MetadataReader {
public:
    MetadataReader(const std::map<std::string, std::string>& metadata, const std::string& where)
        : m_metadata(metadata), m_where(where)
    {
    }

    std::string text(const std::string& key)
    {
        const auto found = m_metadata.find(key);
        if (found != m_metadata.end())
            return found->second;
        fail("metadata '" + key + "' is missing");
        return {};
    }

    std::string one_of(const std::string& key, const std::vector<std::string>& allowed)
    {
        const std::string value = text(key);
        if (m_error.empty() && std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
            std::string list;
            for (const std::string& name : allowed)
                list += (list.empty() ? "'" : " or '") + name + "'";
            fail("metadata '" + key + "' is '" + shown_text(value) + "', must be " + list);
        }
        return value;
    }

    int whole_number_of(const std::string& key, const std::vector<int>& allowed)
    {
        std::vector<std::string> texts;
        for (const int number : allowed)
            texts.push_back(std::to_string(number));
        const auto found = std::find(texts.begin(), texts.end(), one_of(key, texts));
        return found == texts.end() ? 0 : allowed[found - texts.begin()];
    }

    int count(const std::string& key, int limit)
    {
        const std::string value = text(key);
        const bool digits = !value.empty() && value.size() <= 4 &&
                            std::all_of(value.begin(), value.end(), [](char c) { return c >= '0' && c <= '9'; });
        const int number = digits ? std::stoi(value) : 0;
        if (m_error.empty() && (number < 1 || number > limit))
            fail("metadata '" + key + "' is '" + shown_text(value) + "', must be 1 … " + std::to_string(limit));
        return number;
    }

    Status status() const { return m_error.empty() ? Status() : Status(Error{ m_error }); }

private:
    void fail(const std::string& reason)
    {
        if (m_error.empty())
            m_error = m_where + ": " + reason;
    }

    const std::map<std::string, std::string>& m_metadata;
    std::string m_where, m_error;
};

BlockSelector take_selector(TensorTaker& file, const std::string& block, int inputs, int dictionary_size, int layers)
{
    BlockSelector selector;
    selector.encoder = file.take_encoder(block + ".encoder", { inputs, 32, 32, 32, 32 });
    for (int l = 0; l < layers; ++l) {
        const std::string suffix = layers > 1 ? "." + std::to_string(l) : "";
        selector.project.push_back(file.take_dense(block + ".project" + suffix, 32, 128));
        selector.head.push_back(file.take_dense(block + ".head" + suffix, dictionary_size, 32));
    }
    return selector;
}

ToneDictionary take_tone_dictionary(TensorTaker& file, const std::string& name, int atoms, int kernel)
{
    constexpr int channels[] = { 3, 32, 32, 32, 3 };
    ToneDictionary dictionary;
    for (int l = 0; l < kToneLayers; ++l) {
        const std::string layer = name + "." + std::to_string(l);
        const int in = channels[l], out = channels[l + 1];
        dictionary[l] = { in, out, kernel * kernel, file.take(layer + ".weight", { atoms, out, in, kernel, kernel }),
                          file.take(layer + ".bias", { atoms, out }) };
    }
    return dictionary;
}

void require_positive(TensorTaker& file, const std::string& name, const std::vector<float>& atoms)
{
    for (const float atom : atoms)
        if (!(atom > 0))
            file.fail("tensor '" + name + "' has " + std::to_string(atom) + ", must be > 0");
}

void take_scalar_dictionaries(TensorTaker& file, ModelData& model)
{
    const int atoms = model.dictionary_size;
    model.gain_atoms = file.take("dictionary.gain", { atoms });
    require_positive(file, "dictionary.gain", model.gain_atoms);
    model.gamma_atoms = file.take("dictionary.gamma", { atoms });
    require_positive(file, "dictionary.gamma", model.gamma_atoms);
    const std::vector<float> white_balance = file.take("dictionary.white_balance", { atoms, 2 });
    require_positive(file, "dictionary.white_balance", white_balance);
    for (std::size_t i = 0; i + 1 < white_balance.size(); i += 2)
        model.white_balance_atoms.push_back({ white_balance[i], white_balance[i + 1] });

    const std::vector<float> color = file.take("dictionary.color", { atoms, 3, 3 });
    for (std::size_t k = 0; k * 9 < color.size(); ++k) {
        Matrix3 atom;
        std::copy_n(color.begin() + k * 9, 9, atom.begin());
        for (int row = 0; row < 3; ++row)
            if (std::abs(atom[row * 3] + atom[row * 3 + 1] + atom[row * 3 + 2]) < 1e-3f)
                file.fail("tensor 'dictionary.color': row " + std::to_string(row) + " of atom " + std::to_string(k) +
                          " sums to 0, its matrix is degenerate");
        atom = row_normalized(atom);
        if (!(std::abs(determinant(atom)) > 1e-4))
            file.fail("tensor 'dictionary.color': atom " + std::to_string(k) +
                      " is singular, its matrix is degenerate");
        model.color_atoms.push_back(atom);
    }
}

/// Which of the parts that a model may lack it has.
struct Parts {
    bool statistics = false, anchor = false;
    bool anchor_network = false; ///< and its deviation
};

/// Metadata first: it says which tensors there must be, and of which shapes.
Status read_settings(ModelData& model, const std::string& where, Parts& parts)
{
    MetadataReader metadata(model.metadata, where);
    parts.anchor_network = model.white_stays_white = metadata.one_of("format", { "srisp-1", "srisp-7" }) == "srisp-7";
    if (parts.anchor_network)
        model.selection_size =
            metadata.whole_number_of("selection_size", { std::begin(kSelectionSizes), std::end(kSelectionSizes) });
    model.kernel_size = metadata.one_of("kernel_size", { "3", "1" }) == "1" ? 1 : 3;
    model.dictionary_size = metadata.count("dictionary_size", kMaxDictionarySize);
    model.perceptual_encoder_input = metadata.one_of("encoder_input", { "perceptual", "plain" }) == "perceptual";
    parts.statistics = metadata.one_of("statistics", { "12", "0" }) == "12";
    parts.anchor = metadata.one_of("anchor", { "1", "0" }) == "1";
    metadata.text("train_data");
    metadata.text("license");
    if (Status status = metadata.status(); !status)
        return status;
    if (parts.anchor && !parts.statistics)
        return Error{ where + ": metadata 'anchor' is 1 but 'statistics' is 0; the anchor needs the statistics" };
    if (parts.anchor_network && !parts.anchor)
        return Error{ where + ": metadata 'format' is srisp-7 but 'anchor' is 0; its network needs the anchor" };
    return {};
}

} // namespace

Expected<std::unique_ptr<ModelData>> parse_model(const std::string& bytes, const std::string& where)
{
    Expected<SafeTensors> file = parse_safetensors(bytes, where);
    if (!file)
        return file.error();
    auto model = std::make_unique<ModelData>();
    model->metadata = file->metadata;
    Parts parts;
    if (Status status = read_settings(*model, where, parts); !status)
        return status.error();

    TensorTaker tensors(std::move(*file), where);
    const int atoms = model->dictionary_size, candidates = 3 * atoms;
    model->source_encoder = tensors.take_encoder("source_encoder", { 3, 32, 64, 128, 128, 128 });
    model->reference_encoder = tensors.take_encoder("reference_encoder", { 3, 32, 64, 128, 128, 128 });
    if (parts.statistics) {
        model->source_statistics = tensors.take_dense("source_statistics", 128, 12);
        model->reference_statistics = tensors.take_dense("reference_statistics", 128, 12);
    }
    if (parts.anchor)
        model->anchor = tensors.take_dense("anchor", 3, 24);
    if (parts.anchor_network) {
        model->anchor_network = {
            tensors.take_dense("anchor_network.0", 256, 24 + 2 * kQuantileFeatures + kMatchFeatures),
            tensors.take_dense("anchor_network.1", 256, 256), tensors.take_dense("anchor_network.2", 256, 256),
            tensors.take_dense("anchor_network.3", 3, 256)
        };
        model->anchor_deviation = { tensors.take_dense("anchor_deviation.0", 32, 256),
                                    tensors.take_dense("anchor_deviation.1", 1, 32) };
    }
    model->fuse = tensors.take_dense("fuse", 128, 256);
    model->tone = take_selector(tensors, "tone", 3, atoms, kToneLayers);
    model->gamma = take_selector(tensors, "gamma", candidates, atoms, 1);
    model->color = take_selector(tensors, "color", candidates, atoms, 1);
    model->white_balance = take_selector(tensors, "white_balance", candidates, atoms, 1);
    model->gain = take_selector(tensors, "gain", candidates, atoms, 1);
    take_scalar_dictionaries(tensors, *model);
    model->tone_reverse = take_tone_dictionary(tensors, "dictionary.tone_reverse", atoms, model->kernel_size);
    model->tone_forward = take_tone_dictionary(tensors, "dictionary.tone_forward", atoms, model->kernel_size);
    if (Status status = tensors.finish(); !status)
        return status.error();
    return model;
}

} // namespace srisp
