// SPDX-License-Identifier: Apache-2.0
#include "line_files.h"

#include <filesystem>

#include "base/input_file.h"
#include "base/input_files.h"
#include "base/json_text.h"
#include "model/model_files.h"
#include "recipe/frame_pattern.h"
#include "recipe/recipe.h"
#include "recipe/reference_pattern.h"

#include "../common/failure.h"
#include "job.h"
#include "source_file.h"

namespace srisp::tool {

namespace {

const char kDefaultModel[] = "default";

/// The file of a name, or those of a sequence that are on disk.
std::vector<std::string> files_named(const std::string& name, const NameRules& rules)
{
    const auto source = find_source_file(name, rules);
    if (!source || source->wildcard.empty())
        return { name };
    const FrameWildcard wildcard = find_frame_wildcard(name);
    std::vector<std::string> files;
    for (const std::string& frame : source->frames)
        files.push_back(name.substr(0, wildcard.begin) + frame + name.substr(wildcard.begin + wildcard.length));
    return files;
}

void add_model(InputFiles& inputs, const std::string& name)
{
    if (const auto file = find_model_file(name.empty() ? kDefaultModel : name))
        inputs.add("model", *file);
}

/// What merely has the name of a description may be anything, such as saved parameters.
bool describes_samples(const std::string& path)
{
    const auto text = read_text_file(path, kLargestJson);
    return text && text->find("\"width\"") != std::string::npos;
}

void add_references(InputFiles& inputs, const std::vector<std::string>& items)
{
    const auto files = expand_references(items);
    if (!files)
        return; // told where they are read
    for (const std::string& file : *files) {
        inputs.add("reference", file);
        for (const std::string& layout : layout_paths(file))
            if (describes_samples(layout))
                inputs.add("description of the reference", layout);
    }
}

void add_recipe(InputFiles& inputs, const std::string& path)
{
    inputs.add("recipe", path);
    const auto text = read_text_file(path, kLargestJson);
    const auto recipe = text ? recipe_from_json(*text, path, false) : text.error();
    if (!recipe)
        return;
    inputs.add("image", recipe->source);
    if (!recipe->references.empty())
        add_references(inputs, recipe->references);
    add_model(inputs, recipe->model);
}

void add_image(InputFiles& inputs, const std::string& name, const NameRules& rules)
{
    for (const std::string& file : files_named(name, rules))
        if (std::filesystem::path(file).extension() == ".srisp")
            add_recipe(inputs, file);
        else
            inputs.add("image", file);
}

/// What one of our commands reads beside images.
void add_job(InputFiles& inputs, const nlohmann::json& job)
{
    if (job.contains("reference")) {
        const nlohmann::json& reference = job["reference"];
        add_references(inputs, reference.is_string() ? std::vector<std::string>{ reference.get<std::string>() }
                                                     : reference.get<std::vector<std::string>>());
    }
    inputs.add("parameter file", job.value("parameters", ""));
    inputs.add("noise profile", job.value("profile", ""));
    add_model(inputs, job.value("model", ""));
}

/// What a step writes to; "" for most.
std::string output_of(const Step& step)
{
    const bool saves = step.srisp && step.srisp->action == std::string("save");
    const bool writes = step.oiiotool && (step.oiiotool->role == Role::writes || step.is_named("iccwrite"));
    return (saves || writes) && step.words.size() == 2 ? step.words[1] : "";
}

/// Goes through a line from left to right.
class LineFiles {
public:
    explicit LineFiles(const std::vector<Step>& steps) : m_steps(steps), m_end(end_of_reading(steps))
    {
        for (const Step& step : steps)
            if (is_for_images(step))
                add_job(m_inputs, job_of(step));
        // A loop comes back to what was written.
        if (contains(steps, "for") || contains(steps, "while"))
            each_step([](const Step&) {});
    }

    void check()
    {
        each_step([this](const Step& step) {
            const std::string output = output_of(step);
            if (!output.empty())
                for (const std::string& file : files_named(output, m_rules))
                    require(m_inputs.check_output(file));
        });
    }

private:
    template<class Use> void each_step(const Use& use)
    {
        m_rules = {};
        m_rules.frames = contains(m_steps, "frames");
        for (std::size_t i = 0; i < m_steps.size(); ++i) {
            const Step& step = m_steps[i];
            if (step.is_named("evaloff") || step.is_named("evalon"))
                m_rules.expressions = step.is_named("evalon");
            else if (step.is_named("wildcardoff") || step.is_named("wildcardon"))
                m_rules.wildcards = step.is_named("wildcardon");
            if (const std::string name = name_read_by(step); i < m_end && !name.empty())
                add_image(m_inputs, name, m_rules);
            use(step);
        }
    }

    const std::vector<Step>& m_steps;
    const std::size_t m_end;
    NameRules m_rules;
    InputFiles m_inputs;
};

} // namespace

void refuse_inputs_as_outputs(const std::vector<Step>& steps)
{
    LineFiles(steps).check();
}

} // namespace srisp::tool
