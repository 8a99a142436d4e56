// SPDX-License-Identifier: Apache-2.0
#include "bake_options.h"

#include "../common/failure.h"
#include "output_names.h"

namespace srisp::tool {

void describe_options(CLI::App& app, BakeOptions& options)
{
    describe_common_options(app, options);
    app.add_option("--reference", options.reference);
    app.add_option("--source", options.source);
    app.add_option("--params", options.parameters);
    app.add_option("--model", options.model);
    app.add_option("-o,--output", options.output);
    app.add_option("--direction", options.direction)->check(CLI::IsMember({ "unprocess", "process" }));
    app.add_option("--lut-size", options.lut_size)->check(CLI::Range(kSmallestLut, kLargestLut));
    app.add_option("--fragment", options.fragment);
    app.add_option("--linear-srgb", options.linear_srgb);
    app.add_flag("--cube", options.cube);
    app.add_flag("--watch", options.watch);
}

void check_options(const BakeOptions& options)
{
    if (!options.fragment.empty()) {
        if (!options.reference.empty() || !options.parameters.empty() || options.watch)
            fail_usage("--fragment extends a config; --reference, --params and --watch belong to bakes");
        return;
    }
    if (!options.linear_srgb.empty())
        fail_usage("--linear-srgb belongs to --fragment");
    if (options.reference.empty() && options.parameters.empty())
        fail_usage("no reference is given (srispbake --help shows how)");
    if (options.reference.empty() && options.output.empty())
        fail_usage("without --reference there is nothing to name the files after: -o NAME");
    if (!options.direction.empty() && !is_single_file(options.output))
        fail_usage("--direction belongs to one file: -o FILE.clf or -o FILE.cube");
    if (options.cube && is_single_file(options.output))
        fail_usage("--cube belongs to a pair of files; -o FILE.cube makes one");
    if (options.watch && options.json)
        fail_usage("--watch never ends, so it prints no JSON");
}

const char kHelp[] = R"(srispbake -- bakes a reference RAW for hosts of OpenColorIO

Usage: srispbake --reference RAW [--source PHOTO] [options]
       srispbake --params JSON -o NAME [options]
       srispbake --fragment CONFIG [-o FILE]

Writes two CLF files beside the reference, RAW.unprocess.clf (photo to RAW-like)
and RAW.process.clf (back), which the config share/srisp/ocio/srisp.ocio reads
in any host where the context variable SRISP_REFERENCE is the path of RAW. Where
that folder cannot be written to, they go to the folder SRISP_BAKE_PATH.

Parameters are chosen for PHOTO; without one, for the picture that a plain
converter makes of the reference itself. A colour transform sees single pixels,
so the pointwise model is baked; its errors are printed and written into the
file: against the pointwise pipeline, over a grid of colours and over the photo,
and, apart, the difference to the full pipeline (model default).

BakeOptions:
  --reference RAW     The RAW file to be matched
  --source PHOTO      The photo to choose for
  --params JSON       Parameters as srisptool --srisp-params:model=pointwise
                      prints them, edited or not, instead of choosing
  --model NAME        Name or path of a pointwise model; pointwise
  -o, --output NAME   NAME.unprocess.clf and NAME.process.clf instead; or one
                      file, NAME.clf or NAME.cube
  --direction WHICH   Of one file: unprocess (without this) or process
  --cube              .cube files beside the .clf: one table, larger errors
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

} // namespace srisp::tool
