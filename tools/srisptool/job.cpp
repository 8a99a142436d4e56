// SPDX-License-Identifier: Apache-2.0
#include "job.h"

#include <algorithm>

#include "base/near_names.h"

#include "../common/failure.h"
#include "frame_pattern.h"
#include "inputs.h"
#include "modifiers.h"

namespace srisp::tool {

namespace {

const char* const kWithoutReference = "-";

void require_known(const SrispCommand& command, const std::string& word, const std::string& name)
{
    const std::vector<std::string> known(command.modifiers.begin(), command.modifiers.end());
    if (std::find(known.begin(), known.end(), name) == known.end())
        fail_usage("'" + word + "': unknown modifier '" + name + "'" + near_names(name, known));
}

void set_choice(nlohmann::json& job, const std::string& command, const std::string& name, const std::string& value)
{
    const auto require_one_of = [&](const std::vector<std::string>& values, const char* listed) {
        if (std::find(values.begin(), values.end(), value) == values.end())
            fail_usage(command + ": " + name + " is '" + value + "', must be " + listed);
    };
    if (name == "input") {
        require_one_of({ "auto", "srgb", "linear" }, "auto, srgb or linear");
        job["input"] = value;
    } else if (name == "precision") {
        require_one_of({ "float32", "fast" }, "float32 or fast");
        job["precision"] = value;
    } else if (name == "hold") {
        require_one_of({ "0", "1" }, "0 or 1");
        job["hold"] = value == "1";
    } else {
        if (value.find_first_not_of("0123456789") != std::string::npos || value.size() > 18)
            fail_usage(command + ": seed is '" + value + "', must be a whole number of at most 18 digits");
        job["seed"] = std::stoull(value);
    }
}

} // namespace

nlohmann::json job_of(const Step& step)
{
    const SrispCommand& command = *step.srisp;
    const std::string name = std::string("--") + command.name;
    nlohmann::json job = { { "format", "srisp-recipe-1" }, { "direction", command.direction } };
    for (const auto& [modifier, value] : parse_modifiers(step.words[0])) {
        require_known(command, step.words[0], modifier);
        if (modifier == "model")
            job["model"] = model_input(name, value);
        else if (modifier == "params")
            job["parameters"] = file_input(name, "parameter file", value);
        else
            set_choice(job, name, modifier, value);
    }
    if (std::string(command.action) == "save") {
        job["file"] = frame_pattern_of_file(output_path(name, step.words[1]));
    } else if (command.argument && step.words[1] != kWithoutReference) {
        job["reference"] = reference_input(name, step.words[1]);
    } else if (command.argument && !job.contains("parameters")) {
        fail_usage(name + " -: without a reference it needs params=FILE");
    }
    return job;
}

} // namespace srisp::tool
