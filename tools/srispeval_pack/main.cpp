// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "../common/failure.h"
#include "base/progress.h"
#include "model/model_files.h"
#include "pack/training_pack.h"
#include "train/evaluation/evaluation.h"
#include "train/run/model_file.h"
#include "train/settings/settings.h"
#include "train/tensors/torch_api.h"

using namespace srisp;
using namespace srisp::tool;
using namespace srisp::train;

namespace {

struct EvalOptions {
    std::string pack;
    std::vector<std::string> models, baselines, assignments;
    bool json = false, by_camera = false, quiet = false;
    int threads = 0;
};

/// The settings as `--set` asks for them.
EvaluationSettings read_settings(const std::vector<std::string>& assignments)
{
    EvaluationSettings settings;
    nlohmann::json values = nlohmann::json::object();
    for (const std::string& assignment : assignments) {
        const Expected<nlohmann::json> value = parse_assignment(assignment);
        if (!value)
            fail_usage(value.error().message);
        values.update(*value);
    }
    SettingsReader reader(values, "--set");
    settings.describe(reader);
    if (const Status status = reader.finish(); !status)
        fail_usage(status.error().message);
    return settings;
}

std::string settings_text()
{
    EvaluationSettings settings;
    SettingsLister lister;
    settings.describe(lister);
    std::string text = "Settings, for --set:\n";
    for (const SettingRow& row : lister.rows())
        text += "  " + row.key + "=" + row.value + "  (" + row.range + ")\n      " + row.text + "\n";
    return text;
}

constexpr char kExamples[] = R"(
Each set is tested on photos that were made of its RAW images in two ways, which
are scored apart: "random", with random white balance, exposure, gamma and tone
curve; and "fixed", exposed to a fixed target. The left half of a RAW image is
the reference, and the right half of the photo is unprocessed, top and bottom
apart. "gain match" is photo^2.2 times one gain per channel that gives the
reference's means. "+ true means" is the same method, told the truth's channel
means, "+ true gain" its mean: what is left is the error of colour and tone.
"covered" is the part of the distance from gain match to gain match with the
true means. "ln mean error" is that of the brightness of green.

Examples:
  srispeval --pack pack default spatial
  srispeval --pack pack old.safetensors new.safetensors --baseline upi --json
  srispeval --pack pack model.safetensors --set thumbnail_px=256 --by-camera

Exit codes: 0; 1 where something failed, 2 for wrong usage.
)";

/// A method under the name that the table shows.
struct Method {
    std::string name;
    std::shared_ptr<Unprocessor> method;
};

std::vector<Method> load_methods(const EvalOptions& options)
{
    std::vector<Method> methods;
    for (const std::string& name : options.baselines) {
        ModelSettings settings;
        settings.method = name;
        methods.push_back({ name, make_unprocessor(settings, 0) });
    }
    for (const std::string& name : options.models)
        methods.push_back({ model_name_of_path(name), require(load_model(require(find_model_file(name)))).model });
    return methods;
}

int run(const EvalOptions& options)
{
    const EvaluationSettings settings = read_settings(options.assignments);
    if (options.models.empty() && options.baselines.empty())
        fail_usage("nothing to evaluate: give model files or --baseline");
    set_up_process(options.threads);
    const std::vector<Method> methods = load_methods(options);
    const auto set = require(EvaluationSet::make(settings, *require(TrainingPack::open(options.pack))));
    ProgressMeter meter({ "srispeval", "crops", std::int64_t(set->crops() * methods.size()) }, !options.quiet);
    NamedScores scores;
    for (const Method& one : methods) {
        const std::int64_t before = std::int64_t(set->crops()) * scores.size();
        scores.emplace_back(one.name, evaluate(*one.method, *set, [&](int crops) { meter.show(before + crops); }));
    }
    meter.wipe();
    if (!options.json) {
        std::fputs(score_table(scores, options.by_camera).c_str(), stdout);
        return 0;
    }
    nlohmann::ordered_json result;
    for (const auto& [name, of_method] : scores)
        result.push_back({ { "name", name }, { "scores", score_json(of_method) } });
    std::puts(result.dump(2).c_str());
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    EvalOptions options;
    CLI::App app{ "srispeval -- holds models against test images whose truth is known", "srispeval" };
    app.footer([] { return settings_text() + kExamples; });
    app.set_version_flag("--version", "srispeval " SRISP_VERSION);
    app.add_option("models", options.models, "models: names or paths (.safetensors)");
    app.add_option("--pack", options.pack, "training pack, made by srisppack")->required();
    app.add_option("--baseline", options.baselines, "methods that need no model: gain_match, upi")
        ->delimiter(',')
        ->check(CLI::IsMember({ "gain_match", "upi" }));
    app.add_option("--set", options.assignments, "key=value, see below; may be repeated")->allow_extra_args(false);
    app.add_flag("--by-camera", options.by_camera, "lines for each camera, too");
    app.add_flag("--json", options.json, "print JSON on stdout");
    app.add_option("--threads", options.threads, "0: as many as there are processors")->check(CLI::Range(0, 1024));
    app.add_flag("-q,--quiet", options.quiet, "no progress");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : kExitUsage;
    }
    return run_tool("srispeval", [&] { return run(options); });
}
