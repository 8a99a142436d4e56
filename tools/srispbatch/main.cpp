// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "batch_options.h"
#include "batch_run.h"

using namespace srisp;
using namespace srisp::tool;

static int run(BatchOptions& options)
{
    check_options(options);
    watch_interrupts();
    const BatchSummary summary = options.verify ? verify_batch(options.photos[0]) : run_batch(options);
    if (options.json || !options.quiet)
        std::fputs((options.json ? summary_json(summary) : summary_text(summary)).c_str(), stdout);
    return summary.failed ? kExitFailed : 0;
}

int main(int argc, char** argv)
{
    return run_tool("srispbatch", [&] {
        BatchOptions options;
        CLI::App app;
        describe_options(app, options);
        return parse_options(app, options, "srispbatch", kHelp, argc, argv) ? run(options) : 0;
    });
}
