// SPDX-License-Identifier: Apache-2.0
#include "host.h"

#include "model_file.h"
#include "model_metadata.h"

namespace srisp::tool {

using namespace train;

std::optional<Validation> Host::validate(Unprocessor& model, const std::function<void()>& still_there)
{
    if (!m_session.tests)
        return {};
    return validation_of(evaluate(model, *m_session.tests, [&](int) { still_there(); }),
                         m_session.settings().validation.score);
}

Status Host::save_model(Unprocessor& model, const std::string& path, const std::optional<Validation>& result,
                        std::int64_t step)
{
    const Recipe& recipe = m_session.settings();
    std::map<std::string, std::string> metadata = model_metadata(recipe, *m_session.pack);
    nlohmann::ordered_json metrics = { { "recipe", m_session.recipe.name }, { "seed", recipe.seed }, { "step", step } };
    if (result) {
        metrics["psnr"] = result->psnr;
        metrics["angle"] = result->angle;
        metrics["validation"] = result->details;
    }
    metadata["metrics"] = metrics.dump();
    return train::save_model(model, recipe.model, path, metadata, recipe.precision);
}

} // namespace srisp::tool
