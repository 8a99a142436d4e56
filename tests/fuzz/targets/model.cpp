// SPDX-License-Identifier: Apache-2.0
// A model file, whole: one with random values, in which the input edits tensors and metadata.
#include <cmath>

#include <nlohmann/json.hpp>

#include "fuzz_target.h"
#include "model/model_data.h"
#include "random_model.h"

using namespace srisp;

namespace {

/// One edit of what the next bytes say.
void edit(ModelFile& model, fuzz::Draws& draws)
{
    auto tensor = model.tensors.begin();
    std::advance(tensor, draws.below(int(model.tensors.size())));
    Tensor& edited = tensor->second;
    switch (draws.below(8)) {
    case 0: // a value
        if (!edited.values.empty())
            edited.values[std::size_t(draws.below(int(edited.values.size())))] = draws.number<float>();
        break;
    case 1: { // all values
        const float value = draws.odd_float(-2, 2);
        std::fill(edited.values.begin(), edited.values.end(), value);
        break;
    }
    case 2: // the shape, with as many values
        if (!edited.shape.empty())
            std::swap(edited.shape.front(), edited.shape[std::size_t(draws.below(int(edited.shape.size())))]);
        break;
    case 3: // one extent more
        edited.shape.insert(edited.shape.begin() + draws.below(int(edited.shape.size()) + 1), 1);
        break;
    case 4: // fewer values
        edited.shape = { draws.below(64) };
        edited.values.resize(std::size_t(edited.shape[0]));
        break;
    case 5:
        if (model.tensors.size() > 1)
            model.tensors.erase(tensor);
        break;
    case 6: {
        const std::string name = draws.line();
        model.tensors[name] = { { 1 }, { 1 } };
        break;
    }
    case 7: {
        auto entry = model.metadata.begin();
        std::advance(entry, draws.below(int(model.metadata.size())));
        entry->second = draws.line();
        break;
    }
    }
}

void check_model(const ModelData& model)
{
    for (const auto* dictionary : { &model.tone_reverse, &model.tone_forward })
        for (const ConvolutionWeights& layer : *dictionary)
            for (const float value : layer.weight)
                fuzz::must_hold(std::isfinite(value), "weights are finite");
    for (const Matrix3& color : model.color_atoms)
        for (int row = 0; row < 3; ++row)
            fuzz::must_hold(std::fabs(color[row * 3] + color[row * 3 + 1] + color[row * 3 + 2] - 1) < 1e-3f,
                            "rows of colour matrices sum to 1");
    for (const float gain : model.gain_atoms)
        fuzz::must_hold(std::isfinite(gain) && gain > 0, "gains are above 0");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const ModelFile kModels[] = { random_model(1, 1, 2), random_srisp_7_model(1, 2) };
    fuzz::Draws draws(data, size);
    ModelFile file = kModels[draws.below(2)];
    const char* const types[] = { "F16", "BF16", "F32" };
    file.type = types[draws.below(3)];
    for (int i = 0; i < 8 && !draws.at_end(); ++i)
        edit(file, draws);
    std::string bytes;
    try {
        bytes = file.bytes();
    } catch (const nlohmann::json::exception&) {
        return 0; // a name that is no UTF-8
    }
    if (const auto model = parse_model(bytes, "model"); fuzz::is_accepted(model))
        check_model(**model);
    return 0;
}
