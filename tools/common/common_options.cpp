// SPDX-License-Identifier: Apache-2.0
#include "common_options.h"

#include <cstdio>
#include <string>

#include "failure.h"
#include "image_limits_option.h"

namespace srisp::tool {

void describe_common_options(CLI::App& app, CommonOptions& options)
{
    app.set_help_flag();
    app.add_flag("-h,--help", options.help);
    app.add_flag("--version", options.version);
    app.add_option("--threads", options.threads)->check(CLI::Range(0, 1024));
    describe_image_limits(app);
    app.add_flag("--json", options.json);
    app.add_flag("-q,--quiet", options.quiet);
}

bool parse_options(CLI::App& app, const CommonOptions& options, const char* name, const char* help, int argc,
                   char** argv)
{
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        fail_usage(std::string(error.what()) + " (" + name + " --help lists the options)");
    }
    if (options.help)
        std::fputs(help, stdout);
    else if (options.version)
        std::printf("%s %s\n", name, SRISP_VERSION);
    return !options.help && !options.version;
}

} // namespace srisp::tool
