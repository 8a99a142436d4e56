// SPDX-License-Identifier: Apache-2.0
#include <srisp/select.h>

#include <algorithm>

#include <srisp/model.h>

#include "base/guarded.h"
#include "model/model_data.h"
#include "select/selection.h"

namespace srisp {

static Status check_thumbnail(const Thumbnail& thumbnail, const char* which)
{
    const auto bad =
        std::find_if(thumbnail.rgb.begin(), thumbnail.rgb.end(), [](float v) { return !(v >= 0 && v <= 1); });
    if (thumbnail.rgb.size() != 3 * PlanarThumbnail::kCount)
        return Error{ std::string("the ") + which + " thumbnail has " + std::to_string(thumbnail.rgb.size()) +
                      " values, needs " + std::to_string(3 * PlanarThumbnail::kCount) };
    if (bad == thumbnail.rgb.end())
        return {};
    const std::size_t pixel = (bad - thumbnail.rgb.begin()) / 3;
    return Error{ std::string("the ") + which + " thumbnail has " + std::to_string(*bad) + " at (" +
                  std::to_string(pixel % kThumbnailSize) + ", " + std::to_string(pixel / kThumbnailSize) +
                  "), must be within 0 … 1" };
}

Expected<Parameters> select(const Model& model, const Thumbnail& source, const Thumbnail& reference,
                            std::vector<std::string>* notes)
{
    return guarded("selecting parameters", {}, [&]() -> Expected<Parameters> {
        if (Status status = check_thumbnail(source, "source"); !status)
            return status.error();
        if (Status status = check_thumbnail(reference, "reference"); !status)
            return status.error();
        Parameters parameters = select_parameters(model_data(model), source, reference, notes, nullptr);
        parameters.model_name = model.name();
        parameters.model_hash = model.hash();
        if (Status status = check_parameters(parameters, model); !status)
            return Error{ "selecting " + status.error().message };
        return parameters;
    });
}

} // namespace srisp
