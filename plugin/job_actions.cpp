// SPDX-License-Identifier: Apache-2.0
#include "job_actions.h"

#include <cstdio>
#include <filesystem>
#include <regex>

#include <nlohmann/json.hpp>
#include <srisp/metadata.h>

#include "base/output_file.h"
#include "hand_over.h"
#include "result/result_image.h"

namespace srisp {

std::string with_frame(const std::string& pattern, const std::string& frame)
{
    if (frame.empty())
        return pattern;
    std::smatch match;
    if (!std::regex_search(pattern, match, std::regex("#+|%(0?)([0-9]{0,2})d")))
        return pattern;
    const bool hashes = match.str()[0] == '#';
    const std::size_t width = hashes ? match.length() : match[2].length() ? std::stoul(match[2].str()) : 0;
    const std::string sign = frame[0] == '-' ? "-" : "";
    std::string digits = frame.substr(sign.size());
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
    if (sign.size() + digits.size() < width)
        digits.insert(0, width - sign.size() - digits.size(), '0');
    return match.prefix().str() + sign + digits + match.suffix().str();
}

Status print_parameters(const Recipe& job, const std::string& slot_id)
{
    auto image = ResultImage::open(job, open_slot_source(slot_id, job.name), {});
    if (!image)
        return image.error();
    const auto choice = (*image)->choice(0, 0);
    if (!choice)
        return choice.error();
    const auto slot = find_slot(slot_id);
    const std::string image_name = with_frame(job.name, slot ? slot->frame : "");
    const std::string name = nlohmann::json(image_name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    // to_json gives an object; the name goes in front of its first key.
    const std::string line = "{\"image\": " + name + ", " + to_json((*choice)->parameters, -1).substr(1) + "\n";
    if (std::fputs(line.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
        return Error{ "parameters: stdout cannot be written" };
    return {};
}

Status save_parameters(const Recipe& job, const OIIO::ImageSpec& spec, const std::string& frame)
{
    const auto parameters = recorded_parameters(spec, job.name);
    if (!parameters)
        return parameters.error();
    // Folders are literal: they may well hold '#' or '%20d'.
    std::filesystem::path file = job.file;
    file.replace_filename(with_frame(file.filename().string(), frame));
    const Status written = write_output_file(file.string(), to_json(*parameters) + "\n");
    return written ? written : Status(Error{ "parameters " + written.error().message });
}

} // namespace srisp
