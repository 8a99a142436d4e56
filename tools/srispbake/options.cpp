// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include "../common/failure.h"
#include "output_names.h"

namespace srisp::tool {

void describe_options(CLI::App& app, Options& options)
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

void check_options(const Options& options)
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

} // namespace srisp::tool
