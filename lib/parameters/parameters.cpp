// SPDX-License-Identifier: Apache-2.0
#include <srisp/parameters.h>

#include <cmath>
#include <cstdio>

#include <srisp/model.h>

#include "base/matrix3.h"
#include "parameters/parameter_checks.h"

namespace srisp {

static std::string text_of(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

Status check_values(const Parameters& parameters, const std::string& what)
{
    const auto positive = [&](const std::string& key, float value) -> Status {
        if (std::isfinite(value) && value > 0)
            return {};
        return Error{ what + ": '" + key + "' has " + text_of(value) + ", must be finite and > 0" };
    };
    if (Status status = positive("gain", parameters.gain); !status)
        return status;
    if (Status status = positive("gamma", parameters.gamma); !status)
        return status;
    for (const float value : parameters.white_balance)
        if (Status status = positive("white_balance", value); !status)
            return status;
    // Below this an inverse magnifies the last bit of a float to 1 % of full scale.
    if (!(std::abs(determinant(parameters.color)) > 1e-5))
        return Error{ what + ": 'color' is singular (determinant " + text_of(determinant(parameters.color)) + ")" };
    return {};
}

Status check_parameters(const Parameters& parameters, const Model& model)
{
    if (parameters.model_hash != model.hash())
        return Error{ "parameters were chosen with model '" + parameters.model_name + "' (" + parameters.model_hash +
                      "), but '" + model.path() + "' is " + model.hash() };
    for (const std::vector<float>& weights : parameters.tone_weights)
        if (static_cast<int>(weights.size()) != model.dictionary_size())
            return Error{ "parameters have " + std::to_string(weights.size()) + " tone weights per layer, model '" +
                          model.name() + "' needs " + std::to_string(model.dictionary_size()) };
    return check_values(parameters, "parameters");
}

} // namespace srisp
