// SPDX-License-Identifier: Apache-2.0
#include "settings.h"

#include <algorithm>

#include <nlohmann/json.hpp>
#include <srisp/model.h>

#include "../common/failure.h"
#include "base/hashes.h"
#include "base/json_text.h"

namespace srisp::tool {

using nlohmann::ordered_json;

std::string settings_text(const MakingOptions& options)
{
    const auto model = require(Model::load(options.image.model.empty() ? "default" : options.image.model));
    ordered_json settings = { { "format", format_name(options.format) },
                              { "depth", depth_name(options.depth) },
                              { "compression", options.compression },
                              { "mosaic", options.mosaic },
                              { "hold", options.hold },
                              { "model_hash", model->hash() },
                              { "options", options.image_settings } };
    if (options.image.parameters)
        settings["parameters"] = require(parse_json<ordered_json>(to_json(*options.image.parameters, -1)));
    return settings.dump(2, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}

std::string settings_hash(const std::string& text)
{
    return hash_of_bytes(text.data(), text.size());
}

MakingOptions options_of_settings(const std::string& text)
{
    MakingOptions options;
    try {
        const auto settings = require(parse_json<ordered_json>(text));
        for (const OutputFormat format :
             { OutputFormat::exr, OutputFormat::dng, OutputFormat::tif, OutputFormat::png, OutputFormat::npy })
            if (settings.at("format") == format_name(format))
                options.format = format;
        for (const OutputDepth depth : { OutputDepth::half, OutputDepth::float32, OutputDepth::uint16 })
            if (settings.at("depth") == depth_name(depth))
                options.given_depth = depth;
        options.compression = settings.at("compression").get<std::string>();
        options.mosaic = settings.at("mosaic").get<bool>();
        options.image_settings = settings.at("options").get<std::vector<std::pair<std::string, std::string>>>();
    } catch (const ordered_json::exception& error) {
        fail(std::string("the recorded settings cannot be read: ") + error.what());
    }
    // Each line has parameters of its own.
    auto& typed = options.image_settings;
    typed.erase(std::remove_if(typed.begin(), typed.end(), [](const auto& each) { return each.first == "params"; }),
                typed.end());
    options.finish();
    return options;
}

} // namespace srisp::tool
