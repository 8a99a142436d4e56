// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstring>

#include <unistd.h>

#include <OpenImageIO/imageio.h>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "base/installed_files.h"
#include "compare.h"
#include "eval_options.h"
#include "evaluation_run.h"

using namespace srisp;
using namespace srisp::tool;

/// Packs are tested by a program of its own: only the trainer's parts need LibTorch.
static void become_pack_evaluation(char** argv)
{
    const std::string program = own_program("srispeval_pack").string();
    if (program.empty())
        fail("--pack: srispeval_pack is not installed with this program; it is built with the trainer, which needs "
             "LibTorch");
    ::execv(program.c_str(), argv);
    fail("'" + program + "' cannot be started: " + std::strerror(errno));
}

static bool asks_for_pack(int argc, char** argv)
{
    for (int i = 1; i < argc; ++i)
        if (!std::strncmp(argv[i], "--pack", 6) && (argv[i][6] == 0 || argv[i][6] == '='))
            return true;
    return false;
}

static int run(int argc, char** argv)
{
    using Job = EvalOptions::Job;
    if (asks_for_pack(argc, argv))
        become_pack_evaluation(argv);
    const EvalOptions options = read_options(argc, argv);
    watch_interrupts();
    // Files at a time fill the processor; each by itself has one thread.
    OIIO::attribute("threads", 1);
    OIIO::attribute("debug", 0);
    switch (options.job) {
    case Job::help:
        std::fputs(kHelp, stdout);
        return 0;
    case Job::version:
        std::puts("srispeval " SRISP_VERSION);
        return 0;
    case Job::half_split:
        return run_evaluation(options, half_split_protocol(options));
    case Job::pairs:
        return run_evaluation(options, pairs_protocol(options));
    case Job::unpaired:
        return run_evaluation(options, unpaired_protocol(options));
    case Job::compare:
        return compare_evaluations(options);
    }
    return kExitUsage;
}

int main(int argc, char** argv)
{
    return run_tool("srispeval", [&] { return run(argc, argv); });
}
