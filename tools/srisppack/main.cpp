// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>

#include <OpenImageIO/imageio.h>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "help.h"
#include "pack_run.h"

using namespace srisp;

static void parse(int argc, char** argv, Options& options)
{
    CLI::App app;
    describe_options(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        fail_usage(std::string(error.what()) + " (srisppack --help lists the options)");
    }
}

static int run(const Options& options)
{
    if (options.help || options.version) {
        std::fputs(options.help ? kHelp : "srisppack " SRISP_VERSION "\n", stdout);
        return 0;
    }
    if (options.inputs.empty() && options.photos.empty() && options.raws.empty() && options.cameras.empty())
        fail_usage("no input is given (srisppack --help shows how)");
    if (options.output.empty())
        fail_usage("no output is given: -o PACK");
    OIIO::attribute("threads", options.threads);
    watch_interrupts();
    const Summary summary = make_pack(options);
    std::fputs((options.json ? summary_json(summary) : summary_text(summary)).c_str(), stdout);
    return 0;
}

int main(int argc, char** argv)
{
    try {
        Options options;
        parse(argc, argv, options);
        return run(options);
    } catch (const Interrupted& interrupted) {
        std::fprintf(stderr, "srisppack: interrupted; nothing was written\n");
        die_of(interrupted);
    } catch (const Failure& failure) {
        std::fprintf(stderr, "srisppack: %s\n", failure.message.c_str());
        return failure.exit_code;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "srisppack: %s\n", error.what());
        return kExitFailed;
    }
}
