// SPDX-License-Identifier: Apache-2.0
#include "host.h"

#include <cstdio>

#include "model_file.h"
#include "model_metadata.h"

namespace srisp::tool {

using namespace train;

static std::string number_text(const char* format, double value)
{
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// "120/2400, 1.9/s, loss 0.043 (reverse 0.031, forward 0.012), 33.2 dB, 6.1 deg, 20 min left"
static std::string progress_text(const Progress& progress)
{
    std::string text = std::to_string(progress.step) + "/" + std::to_string(progress.steps) + ", " +
                       number_text(progress.steps_per_second < 10 ? "%.2f/s" : "%.0f/s", progress.steps_per_second) +
                       ", loss " + number_text("%.4f", progress.report.loss);
    std::string terms;
    for (const auto& [name, value] : progress.report.terms)
        terms += (terms.empty() ? " (" : ", ") + name + " " + number_text("%.4f", value);
    text += terms.empty() ? "" : terms + ")";
    if (progress.last_validation)
        text += ", " + number_text("%.2f dB, ", progress.last_validation->psnr) +
                number_text("%.2f deg", progress.last_validation->angle);
    return text + ", " + duration_text(progress.seconds_left) + " left";
}

void Host::progress(const Progress& progress)
{
    m_line.show([&] { return progress_text(progress); });
}

void Host::note(const std::string& line)
{
    m_line.wipe();
    std::fprintf(stderr, "srisptrain: %s\n", line.c_str());
}

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
