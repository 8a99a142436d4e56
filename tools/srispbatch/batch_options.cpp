// SPDX-License-Identifier: Apache-2.0
#include "batch_options.h"

#include <cstdlib>

#include "../common/failure.h"
#include "base/parsed_number.h"
#include "base/shown_text.h"

namespace srisp::tool {

namespace {

// What set_option takes, but those that a set decides by itself.
constexpr const char* kImageOptions[] = { "model",        "params",   "input",      "gainmap", "precision",
                                          "brightness",   "levels",   "noise",      "profile", "develop",
                                          "whitebalance", "exposure", "highlights", "resize",  "crop" };

/// From "3/8", counted from 0.
Shard parse_shard(const std::string& text)
{
    const std::size_t slash = std::min(text.find('/'), text.size());
    const auto index = parsed_number<std::uint64_t>(text.substr(0, slash));
    const auto count = parsed_number<std::uint64_t>(text.substr(std::min(slash + 1, text.size())));
    if (!index || !count || *index >= *count)
        fail_usage("--shard '" + shown_text(text) + "' is not I/N with I from 0 to N - 1");
    return { *index, *count };
}

/// What a job array of Slurm says.
std::optional<Shard> shard_of_slurm()
{
    const auto number = [](const char* name) -> std::optional<std::uint64_t> {
        const char* const text = std::getenv(name);
        return text ? parsed_number<std::uint64_t>(text) : std::nullopt;
    };
    const auto id = number("SLURM_ARRAY_TASK_ID"), count = number("SLURM_ARRAY_TASK_COUNT");
    if (!id || !count || *count < 2)
        return {};
    const std::uint64_t least = number("SLURM_ARRAY_TASK_MIN").value_or(0);
    if (*id < least || *id - least >= *count)
        fail_usage("the tasks of this job array are not numbered in steps of 1; give --shard I/N");
    return Shard{ *id - least, *count };
}

void describe_what_is_made(CLI::App& app, BatchOptions& options)
{
    app.add_option("--format", options.format)
        ->transform(CLI::CheckedTransformer(std::map<std::string, OutputFormat>{ { "exr", OutputFormat::exr },
                                                                                 { "dng", OutputFormat::dng },
                                                                                 { "tif", OutputFormat::tif },
                                                                                 { "png", OutputFormat::png },
                                                                                 { "npy", OutputFormat::npy } }));
    app.add_option("--depth", options.given_depth)
        ->transform(CLI::CheckedTransformer(std::map<std::string, OutputDepth>{
            { "half", OutputDepth::half }, { "float", OutputDepth::float32 }, { "uint16", OutputDepth::uint16 } }));
    app.add_option("--compression", options.compression);
    for (const std::string key : kImageOptions)
        app.add_option_function<std::string>(
            "--" + key, [&options, key](const std::string& value) { options.image_settings.emplace_back(key, value); });
    app.add_option_function<std::string>(
        "--phase", [&](const std::string& value) { options.image_settings.emplace_back("mosaic", value); });
    app.add_flag("--mosaic", options.mosaic);
    app.add_flag_callback("--allow-partial", [&] { options.image_settings.emplace_back("allow_partial", "1"); });
    app.add_flag("--hold", options.hold);
}

void describe_the_run(CLI::App& app, BatchOptions& options)
{
    using Job = BatchOptions::Job;
    app.add_option_function<std::string>("--shard",
                                         [&](const std::string& text) { options.shard = parse_shard(text); });
    app.add_option("--photos-per-shard", options.photos_per_shard)->check(CLI::Range(1, 1'000'000'000));
    app.add_option("--memory", options.memory_gb)->check(CLI::Range(0.1, 1e6));
    app.add_flag("--isolate,!--no-isolate", options.isolate);
    app.add_option("--time-limit", options.time_limit)->check(CLI::Range(1.0, 1e6));
    app.add_option("--retry", options.retry)->check(CLI::Range(0, 100));
    app.add_flag("--overwrite", options.overwrite);
    app.add_flag("--dry-run", options.dry_run);
    app.add_flag("--fail-fast", options.fail_fast);
    app.add_flag("--check", options.check);
    app.add_flag_callback("--verify", [&] { options.job = Job::verify; });
    app.add_flag_callback("--merge", [&] { options.job = Job::merge; });
    app.add_option_function<std::string>("--redo", [&](const std::string& text) {
        options.job = Job::redo;
        options.redo = text;
    });
    app.add_flag("--worker", options.worker);
}

void check_finished_set(const BatchOptions& options)
{
    if (options.job == BatchOptions::Job::redo) {
        if (!options.photos.empty() || !options.reference.empty())
            fail_usage("--redo takes a result that is recorded, and -o FILE or nothing else");
        return;
    }
    const std::string name = options.job == BatchOptions::Job::merge ? "--merge" : "--verify";
    if (options.photos.size() != 1 || !options.reference.empty() || !options.output.empty())
        fail_usage(name + " takes one folder, which srispbatch wrote");
}

} // namespace

void describe_options(CLI::App& app, BatchOptions& options)
{
    describe_common_options(app, options);
    app.add_option("photos", options.photos);
    app.add_option("--match", options.match);
    app.add_option("--copy", options.copy)
        ->delimiter(',')
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_option("--reference", options.reference);
    app.add_option("-o,--output", options.output);
    app.add_option_function<std::string>(
           "--pairing",
           [&](const std::string& text) {
               static const std::map<std::string, Pairing> kPairings = { { "random", Pairing::random },
                                                                         { "round-robin", Pairing::round_robin },
                                                                         { "all", Pairing::all },
                                                                         { "csv", Pairing::csv } };
               options.pairing = kPairings.at(text);
               options.pairing_given = true;
           })
        ->check(CLI::IsMember({ "random", "round-robin", "all", "csv" }));
    app.add_option("--per-image", options.per_image)->check(CLI::Range(1, 10000));
    app.add_option("--seed", options.seed);
    describe_what_is_made(app, options);
    describe_the_run(app, options);
}

void check_options(BatchOptions& options)
{
    if (options.job != BatchOptions::Job::make)
        return check_finished_set(options);
    if (options.photos.empty())
        fail_usage("no photos are given (srispbatch --help shows how)");
    if (options.reference.empty())
        fail_usage("no reference is given: --reference REF");
    if (options.output.empty())
        fail_usage("no output is given: -o FOLDER");
    if (options.shard.count == 1)
        options.shard = shard_of_slurm().value_or(options.shard);
    if (options.photos_per_shard > 0 && !options.dry_run)
        fail_usage("--photos-per-shard is for --dry-run, which says how many shards that makes");
    options.finish();
}

} // namespace srisp::tool
