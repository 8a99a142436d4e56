// SPDX-License-Identifier: Apache-2.0
#include "eval_options.h"

#include <algorithm>
#include <map>

#include <CLI/CLI.hpp>

#include "../common/failure.h"
#include "../common/image_limits_option.h"
#include "base/shown_text.h"
#include "converter.h"
#include "photo_rendering.h"

namespace srisp::tool {

namespace {

using Job = EvalOptions::Job;

const std::map<std::string, Job> kJobs = { { "half-split", Job::half_split },
                                           { "pairs", Job::pairs },
                                           { "unpaired", Job::unpaired },
                                           { "compare", Job::compare } };

CLI::Option* add_list(CLI::App& app, const std::string& name, std::vector<std::string>& list)
{
    return app.add_option(name, list)->delimiter(',')->allow_extra_args(false);
}

void describe_evaluation(CLI::App& app, EvalOptions& options)
{
    app.add_option("inputs", options.inputs);
    app.add_option("--model", options.models)->allow_extra_args(false);
    add_list(app, "--baseline", options.baselines)->check(CLI::IsMember({ "gain_match", "upi", "none" }));
    app.add_option("--report", options.report);
    app.add_option("--json", options.json);
    app.add_option("--csv", options.csv);
    app.add_option("--size", options.size)->check(CLI::Range(0, 100000));
    app.add_option("--pictures", options.pictures)->check(CLI::Range(0, 100000));
    app.add_option("--report-size", options.report_mb)->check(CLI::Range(0.1, 10000.0));
    app.add_option("--seed", options.seed);
    app.add_option("--threads", options.threads)->check(CLI::Range(0, 1024));
    app.add_option("--memory", options.memory_gb)->check(CLI::Range(0.1, 1e6));
    describe_image_limits(app);
    app.add_flag("--by-camera", options.by_camera);
    if (options.job == Job::half_split) {
        std::vector<std::string> names{ "all" };
        for (const RenderingKind& kind : rendering_kinds())
            names.emplace_back(kind.name);
        add_list(app, "--rendering", options.renderings)->check(CLI::IsMember(names));
    }
    if (options.job == Job::unpaired) {
        app.add_option("--reference", options.references);
        app.add_option("--references", options.reference_count)->check(CLI::Range(2, 1000));
    } else {
        app.add_option("--edits", options.edits)->check(CLI::Range(0, 1000));
    }
}

/// "all" stands for our own and what is there.
void expand_renderings(EvalOptions& options)
{
    std::vector<std::string> result;
    for (const std::string& name : options.renderings)
        for (const RenderingKind& kind : rendering_kinds()) {
            const bool wanted = name == kind.name || (name == "all" && (!kind.program || is_installed(kind.program)));
            if (wanted && std::find(result.begin(), result.end(), kind.name) == result.end())
                result.emplace_back(kind.name);
        }
    for (const std::string& name : result)
        if (const char* const program = rendering_kind(name).program; program && !is_installed(program))
            fail("--rendering " + name + ": " + program + " is not installed");
    options.renderings = result;
}

void check(EvalOptions& options)
{
    if (options.job == Job::compare) {
        if (options.inputs.size() != 2)
            fail_usage("compare takes two files that srispeval wrote with --json");
        return;
    }
    if (options.inputs.empty())
        fail_usage(options.job == Job::half_split ? "half-split needs RAW files or folders of them"
                   : options.job == Job::pairs    ? "pairs needs a CSV file: photo,raw,reference"
                                                  : "unpaired needs photos or folders of them");
    if (options.job == Job::pairs && options.inputs.size() != 1)
        fail_usage("pairs takes one CSV file");
    if (options.job == Job::unpaired && options.references.empty())
        fail_usage("unpaired needs --reference: RAW files or folders of them");
    std::vector<std::string> baselines;
    for (const std::string& name : options.baselines)
        if (name != "none" && std::find(baselines.begin(), baselines.end(), name) == baselines.end())
            baselines.push_back(name);
    options.baselines = baselines;
    if (options.models.empty())
        options.models = { "default" };
    if (options.job == Job::half_split)
        expand_renderings(options);
}

} // namespace

EvalOptions read_options(int argc, char** argv)
{
    EvalOptions options;
    const std::string word = argc > 1 ? argv[1] : "";
    if (word.empty())
        fail_usage("nothing to do: give half-split, pairs, unpaired, compare or --pack; srispeval --help tells more");
    if (word == "--help" || word == "-h")
        return options;
    if (word == "--version") {
        options.job = Job::version;
        return options;
    }
    const auto job = kJobs.find(word);
    if (job == kJobs.end())
        fail_usage("'" + shown_text(word) +
                   "' is none of half-split, pairs, unpaired, compare, --pack; srispeval --help tells more");
    options.job = job->second;
    CLI::App app;
    bool help = false;
    app.set_help_flag();
    app.add_flag("-h,--help", help);
    app.add_flag("-q,--quiet", options.quiet);
    if (options.job == Job::compare) {
        app.add_option("inputs", options.inputs);
        app.add_option("--json", options.json);
        add_list(app, "--method", options.methods);
    } else {
        describe_evaluation(app, options);
    }
    try {
        app.parse(argc - 1, argv + 1);
    } catch (const CLI::ParseError& error) {
        fail_usage(word + ": " + error.what());
    }
    if (help) {
        options.job = Job::help;
        return options;
    }
    check(options);
    return options;
}

} // namespace srisp::tool
