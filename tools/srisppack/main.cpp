// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include <OpenImageIO/imageio.h>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "pack_options.h"
#include "pack_run.h"

using namespace srisp;
using namespace srisp::tool;

static int run(const PackOptions& options)
{
    if (options.inputs.empty() && options.photos.empty() && options.raws.empty() && options.cameras.empty())
        fail_usage("no input is given (srisppack --help shows how)");
    if (options.output.empty())
        fail_usage("no output is given: -o PACK");
    OIIO::attribute("threads", options.threads);
    watch_interrupts();
    try {
        const Summary summary = make_pack(options);
        std::fputs((options.json ? summary_json(summary) : summary_text(summary)).c_str(), stdout);
    } catch (const Interrupted&) {
        std::fprintf(stderr, "srisppack: interrupted; nothing was written\n");
        throw;
    }
    return 0;
}

int main(int argc, char** argv)
{
    return run_tool("srisppack", [&] {
        PackOptions options;
        CLI::App app;
        describe_options(app, options);
        return parse_options(app, options, "srisppack", kHelp, argc, argv) ? run(options) : 0;
    });
}
