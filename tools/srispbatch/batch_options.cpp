// SPDX-License-Identifier: Apache-2.0
#include "batch_options.h"

#include <charconv>
#include <cstdlib>
#include <optional>

#include "../common/failure.h"
#include "base/shown_text.h"

namespace srisp::tool {

namespace {

// What set_option takes, but those that a set decides by itself.
constexpr const char* kImageOptions[] = { "model",        "params",   "input",     "gainmap", "precision",
                                          "brightness",   "levels",   "noise",     "profile", "develop",
                                          "whitebalance", "exposure", "highlights" };

std::optional<std::uint64_t> whole_number(const std::string& text)
{
    std::uint64_t number = 0;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || failed != std::errc() || end != text.data() + text.size())
        return {};
    return number;
}

/// From "3/8", counted from 0.
Shard parse_shard(const std::string& text)
{
    const std::size_t slash = std::min(text.find('/'), text.size());
    const auto index = whole_number(text.substr(0, slash));
    const auto count = whole_number(text.substr(std::min(slash + 1, text.size())));
    if (!index || !count || *index >= *count)
        fail_usage("--shard '" + shown_text(text) + "' is not I/N with I from 0 to N - 1");
    return { *index, *count };
}

/// What a job array of Slurm says.
std::optional<Shard> shard_of_slurm()
{
    const auto number = [](const char* name) -> std::optional<std::uint64_t> {
        const char* const text = std::getenv(name);
        return text ? whole_number(text) : std::nullopt;
    };
    const auto id = number("SLURM_ARRAY_TASK_ID"), count = number("SLURM_ARRAY_TASK_COUNT");
    if (!id || !count || *count < 2)
        return {};
    const std::uint64_t least = number("SLURM_ARRAY_TASK_MIN").value_or(0);
    if (*id < least || *id - least >= *count)
        fail_usage("the tasks of this job array are not numbered in steps of 1; give --shard I/N");
    return Shard{ *id - least, *count };
}

void set(BatchOptions& options, const std::string& key, const std::string& value)
{
    if (const Status done = set_option(options.image, key, value); !done)
        fail_usage(done.error().message);
}

/// Half floats are as exact as a RAW file's codes; TIFF readers seldom know them.
OutputDepth usual_depth(OutputFormat format)
{
    switch (format) {
    case OutputFormat::tif:
        return OutputDepth::float32;
    case OutputFormat::dng:
    case OutputFormat::png:
        return OutputDepth::uint16;
    case OutputFormat::exr:
    case OutputFormat::npy:
        break;
    }
    return OutputDepth::half;
}

bool is_typed(const BatchOptions& options, const std::string& key)
{
    for (const auto& [typed, value] : options.image_settings)
        if (typed == key)
            return true;
    return false;
}

} // namespace

const char* format_name(OutputFormat format)
{
    static const char* const kNames[] = { "exr", "dng", "tif", "png", "npy" };
    return kNames[int(format)];
}

const char* depth_name(OutputDepth depth)
{
    static const char* const kNames[] = { "half", "float", "uint16" };
    return kNames[int(depth)];
}

void describe_options(CLI::App& app, BatchOptions& options)
{
    describe_common_options(app, options);
    app.add_option("photos", options.photos);
    app.add_option("--match", options.match);
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
    app.add_option_function<std::string>("--shard",
                                         [&](const std::string& text) { options.shard = parse_shard(text); });
    app.add_option("--format", options.format)
        ->transform(CLI::CheckedTransformer(std::map<std::string, OutputFormat>{ { "exr", OutputFormat::exr },
                                                                                 { "dng", OutputFormat::dng },
                                                                                 { "tif", OutputFormat::tif },
                                                                                 { "png", OutputFormat::png },
                                                                                 { "npy", OutputFormat::npy } }));
    app.add_option("--depth", options.given_depth)
        ->transform(CLI::CheckedTransformer(std::map<std::string, OutputDepth>{
            { "half", OutputDepth::half }, { "float", OutputDepth::float32 }, { "uint16", OutputDepth::uint16 } }));
    for (const std::string key : kImageOptions)
        app.add_option_function<std::string>(
            "--" + key, [&options, key](const std::string& value) { options.image_settings.emplace_back(key, value); });
    app.add_option_function<std::string>(
        "--phase", [&](const std::string& value) { options.image_settings.emplace_back("mosaic", value); });
    app.add_flag("--mosaic", options.mosaic);
    app.add_flag_callback("--allow-partial", [&] { options.image_settings.emplace_back("allow_partial", "1"); });
    app.add_option("--memory", options.memory_gb)->check(CLI::Range(0.1, 1e6));
    app.add_flag("--overwrite", options.overwrite);
    app.add_flag("--dry-run", options.dry_run);
    app.add_flag("--fail-fast", options.fail_fast);
    app.add_flag("--check", options.check);
    app.add_flag("--verify", options.verify);
}

void check_options(BatchOptions& options)
{
    if (options.verify) {
        if (options.photos.size() != 1 || !options.reference.empty() || !options.output.empty())
            fail_usage("--verify takes one folder, which srispbatch wrote");
        return;
    }
    if (options.photos.empty())
        fail_usage("no photos are given (srispbatch --help shows how)");
    if (options.reference.empty())
        fail_usage("no reference is given: --reference REF");
    if (options.output.empty())
        fail_usage("no output is given: -o FOLDER");
    if (options.shard.count == 1)
        options.shard = shard_of_slurm().value_or(options.shard);
    options.depth = options.given_depth.value_or(usual_depth(options.format));
    if (options.format == OutputFormat::exr && options.depth == OutputDepth::uint16)
        fail_usage("--depth uint16: EXR holds half and float");
    if (options.format == OutputFormat::png && options.depth != OutputDepth::uint16)
        fail_usage(std::string("--depth ") + depth_name(options.depth) + ": PNG holds 16 bits");
    if (options.mosaic)
        set(options, "mosaic", "reference");
    for (const auto& [key, value] : options.image_settings)
        set(options, key, value);
    const bool codes = options.depth == OutputDepth::uint16 && options.image.mosaic && !is_typed(options, "levels");
    if (codes)
        set(options, "levels", "camera");
    if (options.format == OutputFormat::tif && options.depth == OutputDepth::half)
        fail_usage("--depth half: TIFF holds uint16 and float");
    if (options.format == OutputFormat::dng && !options.image.develop.empty())
        fail_usage("--develop: a DNG holds camera RGB");
}

const char kHelp[] = R"(srispbatch -- makes RAW-like images of a whole set of photos, and goes on where it
was stopped

Usage: srispbatch PHOTOS... --reference REF -o FOLDER [options]
       srispbatch --verify FOLDER

PHOTOS are files, folders (with all folders in them), globs, @LIST (a file with
a name on each line) or - (such a list on stdin). A result has the name of its
photo, in the same folders: street/0001.jpg becomes FOLDER/street/0001.exr.

The same command goes on: what is done is not made again, what failed is tried
again. FOLDER/manifest/ has a line of JSON for each result, and failed.jsonl.

Options:
  --reference REF     RAW file, folder, glob or list of these; or a CSV file
                      with the columns reference,weight or photo,reference
  --pairing HOW       random (without this), round-robin, all, or csv
  --per-image N       Results for each photo, with references of their own; 1
  --seed N            Decides references, noise and sampled brightness; 0
  --match GLOB        Files of that name instead of images by their endings
  --shard I/N         One part of N of the photos, I from 0; in a job array of
                      Slurm its task
  --format KIND       exr (without this), dng, tif, png or npy
  --depth KIND        half, float or uint16, as the format holds it
  --mosaic            As a sensor's filters let through, of the reference's phase
  --phase PHASE       The same of this phase: RGGB, GRBG, GBRG, BGGR
  --noise SOURCE      reference, iso=N, shot=A,read=B or upi
  --model NAME, --params FILE, --input KIND, --gainmap USE, --precision KIND,
  --brightness EV, --levels KIND, --profile FILE, --develop SPACE,
  --whitebalance WHITE, --exposure EV, --highlights HOW
                      As srisptool's commands have them (srisptool --srisp-help)
  --allow-partial     Take photos that break off as far as they go
  --overwrite         Make again what is there, whatever made it
  --check             Compare what is done with its hash, and make it again
                      where that differs
  --verify FOLDER     Only compare all results of a set with their hashes
  --dry-run           Say what would be done
  --fail-fast         Stop at the first photo that fails
  --memory GB         Images in memory at a time; a quarter of the machine's
  --threads N         Photos at a time; 0: one for each processor; 0
  --json              The summary on stdout as JSON
  -q, --quiet         No progress and no summary
  -h, --help          Print this
  --version           Print the version

Examples:
  srispbatch photos/ --reference refs/ -o raw/
  srispbatch @coco.txt --reference refs.csv --per-image 3 --seed 7 --mosaic \
             --noise reference --format dng -o coco_raw
  srispbatch photos/ --reference refs/ --format npy --depth uint16 -o raw/

Exit codes: 0; 1 where some failed; 2 for wrong usage; 128 and the signal's
number where a signal ended it. No incomplete file is left.
)";

} // namespace srisp::tool
