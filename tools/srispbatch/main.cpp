// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "batch_options.h"
#include "batch_run.h"
#include "finished_set.h"
#include "manifest.h"
#include "worker.h"

using namespace srisp;
using namespace srisp::tool;

static int merge(const BatchOptions& options)
{
    const std::size_t results = merge_manifests(options.photos[0]);
    if (!options.quiet)
        std::printf("%zu results in one manifest\n", results);
    return 0;
}

static int run(BatchOptions& options)
{
    using Job = BatchOptions::Job;
    check_options(options);
    // Where a photo has no date, its file's would make other bytes of a set that was copied.
    ::setenv("SOURCE_DATE_EPOCH", "0", 0);
    if (options.worker) {
        serve_tasks(options);
        return 0;
    }
    watch_interrupts();
    switch (options.job) {
    case Job::merge:
        return merge(options);
    case Job::redo:
        redo_result(options);
        return 0;
    case Job::verify:
        return verify_set(options) ? kExitFailed : 0;
    case Job::make:
        break;
    }
    return run_batch(options) ? kExitFailed : 0;
}

int main(int argc, char** argv)
{
    return run_tool("srispbatch", [&] {
        BatchOptions options;
        options.arguments.assign(argv + 1, argv + argc);
        CLI::App app;
        describe_options(app, options);
        return parse_options(app, options, "srispbatch", kHelp, argc, argv) ? run(options) : 0;
    });
}
