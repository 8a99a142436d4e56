// SPDX-License-Identifier: Apache-2.0
#include <srisp/select.h>

#include <algorithm>

#include <srisp/model.h>

#include "base/guarded.h"
#include "features/lanes.h"
#include "model/model_data.h"
#include "select/selection.h"

namespace srisp {

/// How many are not within 0 … 1.
SRISP_WIDE_LANES static int count_outside(const float* values, std::size_t count)
{
    int outside = 0;
    for (std::size_t i = 0; i < count; ++i)
        outside += !(values[i] >= 0.0f) | !(values[i] <= 1.0f);
    return outside;
}

static Status check_thumbnail(const Thumbnail& thumbnail, const char* which)
{
    const auto is_bad = [](float v) { return !(v >= 0 && v <= 1); };
    constexpr std::size_t count = 3 * std::size_t(kThumbnailSize) * kThumbnailSize;
    if (thumbnail.rgb.size() != count)
        return Error{ std::string("the ") + which + " thumbnail has " + std::to_string(thumbnail.rgb.size()) +
                      " values, needs " + std::to_string(count) };
    if (count_outside(thumbnail.rgb.data(), count) == 0)
        return {};
    const auto bad = std::find_if(thumbnail.rgb.begin(), thumbnail.rgb.end(), is_bad);
    const std::size_t pixel = (bad - thumbnail.rgb.begin()) / 3;
    return Error{ std::string("the ") + which + " thumbnail has " + std::to_string(*bad) + " at (" +
                  std::to_string(pixel % kThumbnailSize) + ", " + std::to_string(pixel / kThumbnailSize) +
                  "), must be within 0 … 1" };
}

Expected<PreparedReference> prepare_reference(const Model& model, const Thumbnail& reference)
{
    return guarded("preparing a reference", {}, [&]() -> Expected<PreparedReference> {
        if (Status status = check_thumbnail(reference, "reference"); !status)
            return status.error();
        return PreparedReference(
            std::make_shared<const ReferenceFeatures>(reference_features(model_data(model), reference)));
    });
}

Expected<Parameters> select(const Model& model, const Thumbnail& source, const PreparedReference& reference,
                            std::vector<std::string>* notes)
{
    return guarded("selecting parameters", {}, [&]() -> Expected<Parameters> {
        if (Status status = check_thumbnail(source, "source"); !status)
            return status.error();
        if (reference.features().model_hash != model.hash())
            return Error{ "the reference was prepared for the model " + reference.features().model_hash + ", but '" +
                          model.path() + "' is " + model.hash() };
        Parameters parameters = select_parameters(model_data(model), source, reference.features(), notes, nullptr);
        parameters.model_name = model.name();
        parameters.model_hash = model.hash();
        if (Status status = check_parameters(parameters, model); !status)
            return Error{ "selecting " + status.error().message };
        if (const std::string note = brightness_note(parameters); notes && !note.empty())
            notes->push_back(note);
        return parameters;
    });
}

Expected<Parameters> select(const Model& model, const Thumbnail& source, const Thumbnail& reference,
                            std::vector<std::string>* notes)
{
    const auto prepared = prepare_reference(model, reference);
    return prepared ? select(model, source, *prepared, notes) : prepared.error();
}

} // namespace srisp
