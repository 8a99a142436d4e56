// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <srisp/image.h>

#include "pack/training_pack.h"

namespace srisp::tool {

void describe_options(CLI::App& app, Options& options)
{
    describe_common_options(app, options);
    app.add_option("inputs", options.inputs);
    app.add_option("--photos", options.photos)->allow_extra_args(false);
    app.add_option("--raws", options.raws)->allow_extra_args(false);
    app.add_option("--cameras", options.cameras)->allow_extra_args(false);
    app.add_option("-o,--output", options.output);
    app.add_option("--size", options.size)->check(CLI::Range(kSmallestPackImage, kLargestPackImage));
    // RAW images are cut from the thumbnail that is made for references.
    app.add_option("--raw-size", options.raw_size)->check(CLI::Range(kSmallestPackImage, kThumbnailSize));
    app.add_option("--crops", options.crops)->check(CLI::Range(0, 100));
    app.add_option("--seed", options.seed);
    app.add_flag("--open-only", options.open_only);
    app.add_flag("--strict", options.strict);
    app.add_flag("--replace", options.replace);
}

} // namespace srisp::tool
