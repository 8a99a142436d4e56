// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispbake/bake_options.h"

#include <doctest/doctest.h>

#include "../failure_of.h"

using namespace srisp;
using namespace srisp::tool;

static std::string complaint(const std::string& command_line)
{
    return failure_of([&] {
        BakeOptions options;
        CLI::App app;
        describe_options(app, options);
        app.parse(command_line);
        check_options(options);
    });
}

TEST_CASE("options that go together pass, others are named")
{
    for (const char* good : { "--reference r.dng", "--reference r.dng --cube --watch", "--params p.json -o x",
                              "--reference r -o x.cube --direction process", "--fragment c.ocio -o d.ocio" })
        CHECK(complaint(good) == "");
    CHECK(complaint("").find("2: no reference is given") == 0);
    CHECK(complaint("--params p.json").find("2: without --reference") == 0);
    CHECK(complaint("--reference r --direction process").find("2: --direction belongs to one file") == 0);
    CHECK(complaint("--reference r -o x.cube --cube").find("2: --cube belongs to a pair") == 0);
    CHECK(complaint("--reference r --watch --json").find("2: --watch never ends") == 0);
    CHECK(complaint("--fragment c --reference r").find("2: --fragment extends a config") == 0);
    CHECK(complaint("--reference r --linear-srgb x").find("2: --linear-srgb belongs to --fragment") == 0);
}
