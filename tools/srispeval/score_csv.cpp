// SPDX-License-Identifier: Apache-2.0
#include "score_csv.h"

#include <cmath>

#include "base/printed.h"
#include "metric_table.h"

namespace srisp::tool {

namespace {

std::string csv_text(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char c : text)
        quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

std::string csv_number(double value)
{
    return std::isfinite(value) ? printed("%.7g", value) : "";
}

} // namespace

std::string to_csv(const Evaluation& evaluation)
{
    std::string text = "image,part,rendering,camera,reference,method";
    for (const Metric& metric : metrics())
        text += std::string(",") + metric.key;
    text += "\n";
    for (const ImageScore& image : evaluation.images)
        for (const std::string& method : evaluation.methods) {
            const auto score = image.methods.find(method);
            if (score == image.methods.end())
                continue;
            text += csv_text(image.image) + "," + image.part + "," + csv_text(image.rendering) + "," +
                    csv_text(image.camera) + "," + csv_text(image.reference) + "," + csv_text(method);
            for (const Metric& metric : metrics()) {
                const auto value = score->second.values.find(metric.key);
                text += "," + (value == score->second.values.end() ? "" : csv_number(value->second.value()));
            }
            text += "\n";
        }
    return text;
}

} // namespace srisp::tool
