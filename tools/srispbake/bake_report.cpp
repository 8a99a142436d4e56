// SPDX-License-Identifier: Apache-2.0
#include "bake_report.h"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "../common/shell_quote.h"
#include "base/printed.h"

namespace srisp::tool {

namespace {

using nlohmann::ordered_json;

std::string size_text(const ErrorSize& error)
{
    return printed("largest %.2g, mean %.2g", error.largest, error.mean());
}

/// What SRISP_REFERENCE must be for a file to be found: its path without ".unprocess.clf". "" for other names.
std::string reference_value(const std::string& path)
{
    const std::string end = ".unprocess.clf";
    if (path.size() <= end.size() || path.compare(path.size() - end.size(), end.size(), end) != 0)
        return {};
    std::error_code error;
    return std::filesystem::absolute(path.substr(0, path.size() - end.size()), error).lexically_normal().string();
}

ordered_json json_of(const std::optional<ErrorSize>& error)
{
    if (!error)
        return nullptr;
    return { { "largest", error->largest }, { "mean", error->mean() } };
}

std::string value_of_variable(const BakeSummary& summary)
{
    return summary.files.empty() ? "" : reference_value(summary.files[0].name.path);
}

} // namespace

std::string error_sentence(const BakeErrors& errors, const BakeChoice& choice)
{
    std::string sentence = "Error against srisptool's pixels: over a grid of colours " + size_text(errors.grid);
    if (errors.photo)
        sentence += "; over " + choice.photo->name + " " + size_text(*errors.photo);
    return sentence + ".";
}

std::string summary_text(const BakeSummary& summary)
{
    std::string text;
    for (const BakeReport& file : summary.files) {
        const bool small = file.bytes < 100'000;
        const std::string size =
            printed("%.1f %s", static_cast<double>(file.bytes) / (small ? 1e3 : 1e6), small ? "kB" : "MB");
        text += file.name.path + " (" + size + ")\n  " + file.sentence + "\n";
    }
    const std::string value = value_of_variable(summary);
    return value.empty() ? text : text + "In the host: " + shell_line({ "SRISP_REFERENCE=" + value }) + "\n";
}

std::string summary_json(const BakeSummary& summary)
{
    ordered_json files = ordered_json::array();
    for (const BakeReport& file : summary.files)
        files.push_back({ { "path", file.name.path },
                          { "direction", kind_name(file.name.kind) },
                          { "bytes", file.bytes },
                          { "error_over_grid", json_of(file.errors.grid) },
                          { "error_over_photo", json_of(file.errors.photo) } });
    const ordered_json all = { { "SRISP_REFERENCE", value_of_variable(summary) },
                               { "photo", summary.photo },
                               { "files", files } };
    return all.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string name_warning(const std::string& reference)
{
    const bool dollar = reference.find('$') != std::string::npos;
    if (!dollar && reference.find('%') == std::string::npos)
        return {};
    return std::string("the reference's name has a '") + (dollar ? '$' : '%') +
           "', which OpenColorIO may take for a variable of the config; a plain name is safer";
}

} // namespace srisp::tool
