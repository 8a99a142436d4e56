// SPDX-License-Identifier: Apache-2.0
#include "bake_options.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "../common/failure.h"
#include "base/device_output.h"
#include "base/file_bytes.h"
#include "base/hashes.h"
#include "base/shown_text.h"
#include "ocio/src/operators.h"

namespace srisp::tool {

namespace {

bool ends_with(const std::string& text, const std::string& end)
{
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

} // namespace

void describe_options(CLI::App& app, BakeOptions& options)
{
    describe_common_options(app, options);
    app.add_option("--reference", options.reference);
    app.add_option("--source", options.source);
    app.add_option("--params", options.parameters);
    app.add_option("--model", options.model);
    app.add_option("--brightness", options.brightness);
    app.add_option("--seed", options.seed);
    app.add_option("--whitebalance", options.white_balance);
    app.add_option("--exposure", options.exposure);
    app.add_option("--highlights", options.highlights);
    app.add_option("-o,--output", options.output);
    app.add_option("--direction", options.direction)->check(CLI::IsMember({ "unprocess", "process", "develop" }));
    app.add_option("--lut-size", options.lut_size)->check(CLI::Range(kSmallestLut, kLargestLut));
    app.add_option("--fragment", options.fragment);
    app.add_option("--linear-srgb", options.linear_srgb);
    app.add_flag("--allow-partial", options.allow_partial);
    app.add_flag("--cube", options.cube);
    app.add_flag("--watch", options.watch);
}

Options development_options(const BakeOptions& options)
{
    Options parsed;
    parsed.develop = "ACES2065-1";
    const std::pair<const char*, const std::string&> given[] = { { "whitebalance", options.white_balance },
                                                                 { "exposure", options.exposure },
                                                                 { "highlights", options.highlights } };
    for (const auto& [key, value] : given)
        if (!value.empty())
            if (const Status set = set_option(parsed, key, value); !set)
                fail_usage(set.error().message);
    if (parsed.highlights == Highlights::blend)
        fail_usage("highlights that are blended have no OpenColorIO transform: clip or keep");
    return parsed;
}

void check_options(const BakeOptions& options)
{
    if (!options.fragment.empty()) {
        if (!options.reference.empty() || !options.parameters.empty() || !options.brightness.empty() || options.watch)
            fail_usage("--fragment extends a config; --reference, --params, --brightness and --watch belong to bakes");
        return;
    }
    if (!options.linear_srgb.empty())
        fail_usage("--linear-srgb belongs to --fragment");
    Options parsed;
    if (!options.brightness.empty())
        if (const Status set = set_option(parsed, "brightness", options.brightness); !set)
            fail_usage(set.error().message);
    development_options(options);
    if (options.reference.empty() && options.parameters.empty())
        fail_usage("no reference is given (srispbake --help shows how)");
    if (options.reference.empty() && options.output.empty())
        fail_usage("without --reference there is nothing to name the files after: -o NAME");
    if (!options.direction.empty() && !is_single_file(options.output))
        fail_usage("--direction belongs to one file: -o FILE.clf or -o FILE.cube");
    if (options.direction == "develop" && ends_with(options.output, ".cube"))
        fail_usage("a development takes values of any size, which a .cube file cannot: -o FILE.clf");
    if (options.cube && is_single_file(options.output))
        fail_usage("--cube belongs to a pair of files; -o FILE.cube makes one");
    if (options.watch && options.json)
        fail_usage("--watch never ends, so it prints no JSON");
}

const char kHelp[] = R"(srispbake -- bakes a reference RAW for hosts of OpenColorIO

Usage: srispbake --reference RAW [--source PHOTO] [options]
       srispbake --params JSON -o NAME [options]
       srispbake --fragment CONFIG [-o FILE]

Writes three CLF files beside the reference, RAW.unprocess.clf (photo to
RAW-like), RAW.process.clf (back) and RAW.develop.clf (RAW-like to ACES2065-1),
which the config share/srisp/ocio/srisp.ocio reads in any host where the context
variable SRISP_REFERENCE is the path of RAW. Where that folder cannot be written
to, they go to the folder SRISP_BAKE_PATH.

Parameters are chosen for PHOTO; without one, for the picture that a plain
converter makes of the reference itself. How far a bake is from srisptool's
pixels, over a grid of colours and over the photo, is printed and written into
the file.

Options:
  --reference RAW     The RAW file to be matched
  --source PHOTO      The photo to choose for
  --allow-partial     Take a PHOTO that breaks off as far as it goes
  --max-megapixels N  Refuse images of more than N million pixels; 2000
  --params JSON       Parameters as srisptool --srisp-params prints them,
                      edited or not, instead of choosing
  --model NAME        Name or path of a model that sees single pixels (kernel
                      size 1), as colour transforms do; default
  --brightness EV     Make the RAW-like result that much brighter, or darker
                      below 0; sample draws from how unsure the brightness is,
                      by the seed and the photo's name
  --seed N            Of the sampled brightness; 0
  --whitebalance W    Of RAW.develop.clf, what becomes white: scene (what is
                      white in PHOTO; without this), reference (in RAW's light),
                      KELVIN, KELVIN,TINT or multipliers R,G,B
  --exposure EV       Of RAW.develop.clf: brighter by that much; 0
  --highlights HOW    Of RAW.develop.clf: clip (without this) or keep
  -o, --output NAME   NAME.unprocess.clf, NAME.process.clf and NAME.develop.clf
                      instead; or one file, NAME.clf or NAME.cube; or a device
                      or pipe
  --direction WHICH   Of one file: unprocess (without this), process or develop
  --cube              .cube files beside the first two: one table, larger errors
  --lut-size N        Points along each side of tables, 5 to 129; 65
  --watch             Bake again when reference, photo, parameters or model
                      change, until it is interrupted
  --fragment CONFIG   Add our looks and colour spaces to an OpenColorIO config
                      (profile version 2), and the neutral bakes to its search
                      path; all else in it stays as it is
  --linear-srgb NAME  The colour space of CONFIG that is linear with sRGB
                      primaries, where it has no usual name
  --threads N         0: one for each processor; 0
  --json              What was written, and errors, on stdout as JSON
  -q, --quiet         Print nothing
  -h, --help          Print this
  --version           Print the version

Examples:
  srispbake --reference plate.dng --source photo.jpg
  srispbake --reference plate.dng --params look.json --watch
  srispbake --reference plate.dng -o look.cube --lut-size 33
  srispbake --fragment studio.ocio

Environment:
  SRISP_BAKE_PATH   folder for bakes of references in read-only folders
  SRISP_MODEL_PATH  folders with models, separated by colons

Exit codes: 0, 1 where something failed, 2 for wrong usage; 128 and the signal's
number where a signal ended it. No incomplete file is left.
)";

namespace fs = std::filesystem;

namespace {

const char kReferenceLine[] = "Reference: ";

/// Where the pair of a reference is named after; the folder can be written to.
std::string stem_of_reference(const std::string& reference)
{
    const fs::path path(reference), folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (access(folder.c_str(), W_OK) == 0)
        return reference;
    const char* variable = std::getenv("SRISP_BAKE_PATH");
    if (!variable || !*variable)
        fail("folder '" + folder.string() +
             "' cannot be written to; set SRISP_BAKE_PATH to a folder for bakes, or give -o NAME");
    if (access(variable, W_OK) != 0)
        fail("neither folder '" + folder.string() + "' nor '" + variable +
             "' (SRISP_BAKE_PATH) can be written to; give -o NAME");
    return (fs::path(variable) / path.filename()).string();
}

} // namespace

bool is_single_file(const std::string& output)
{
    return ends_with(output, ".clf") || ends_with(output, ".cube") || is_device_output(output);
}

const char* kind_name(BakeKind kind)
{
    static const char* const kNames[] = { "unprocess", "process", "develop" };
    return kNames[int(kind)];
}

std::vector<OutputName> output_names(const std::string& reference, const std::string& output,
                                     const std::string& direction, bool cube)
{
    if (is_single_file(output))
        return { { output,
                   direction == "process"   ? BakeKind::process
                   : direction == "develop" ? BakeKind::develop
                                            : BakeKind::unprocess,
                   ends_with(output, ".cube") } };
    const std::string stem = (output.empty() ? stem_of_reference(reference) : output) + ".";
    std::vector<OutputName> names;
    for (const bool as_cube : { false, true })
        for (const BakeKind each : { BakeKind::unprocess, BakeKind::process, BakeKind::develop })
            if (!as_cube || (cube && each != BakeKind::develop))
                names.push_back({ stem + kind_name(each) + (as_cube ? ".cube" : ".clf"), each, as_cube });
    return names;
}

std::string reference_line(const std::string& reference)
{
    const fs::path path(reference);
    const std::string folder = path.parent_path().string();
    return kReferenceLine + path.filename().string() + ", in the folder " +
           xxh64_of_bytes(folder.data(), folder.size());
}

void refuse_bake_of_another(const std::string& path, const std::string& reference)
{
    constexpr std::size_t kHeadOfBake = 16384;
    const auto head = read_head(path, kHeadOfBake);
    const std::size_t start = head ? head->find(kReferenceLine) : std::string::npos;
    if (start == std::string::npos)
        return;
    const std::string line = head->substr(start, head->find_first_of("<\n", start) - start);
    if (line != reference_line(reference) && line != clf_escaped(reference_line(reference)))
        fail("'" + path + "' is the bake of another reference, of the same name, in another folder than '" +
             fs::path(reference).parent_path().string() + "'; remove it, or give -o NAME");
}

} // namespace srisp::tool
