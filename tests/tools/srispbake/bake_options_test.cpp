// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispbake/bake_options.h"

#include <doctest/doctest.h>

#include "../../../ocio/src/operators.h"
#include "../failure_of.h"
#include "scratch_folder.h"

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
    CHECK(complaint("--reference r -o x.cube --direction develop").find("2: a development takes values of any size") ==
          0);
    CHECK(complaint("--reference r --highlights blend").find("2: highlights that are blended have no OpenColorIO") ==
          0);
    CHECK(complaint("--reference r --exposure much").find("2: exposure 'much' is no number") == 0);
    CHECK(complaint("--fragment c --reference r").find("2: --fragment extends a config") == 0);
    CHECK(complaint("--reference r --linear-srgb x").find("2: --linear-srgb belongs to --fragment") == 0);
}

static std::string joined(const std::vector<OutputName>& names)
{
    std::string text;
    for (const OutputName& name : names)
        text += name.path + " " + kind_name(name.kind) + "\n";
    return text;
}

TEST_CASE("a pair is named after the reference or what -o says, and one file is what -o says")
{
    const ScratchFolder folder;
    const std::string raw = folder.path("r.dng");
    CHECK(joined(output_names(raw, "", "", false)) ==
          raw + ".unprocess.clf unprocess\n" + raw + ".process.clf process\n" + raw + ".develop.clf develop\n");
    CHECK(joined(output_names(raw, "x", "", true)) ==
          "x.unprocess.clf unprocess\nx.process.clf process\nx.develop.clf develop\n"
          "x.unprocess.cube unprocess\nx.process.cube process\n");
    CHECK(joined(output_names(raw, "y.clf", "", false)) == "y.clf unprocess\n");
    CHECK(joined(output_names(raw, "y.cube", "process", false)) == "y.cube process\n");
    CHECK(joined(output_names(raw, "y.clf", "develop", false)) == "y.clf develop\n");
}

TEST_CASE("a bake of another reference is not overwritten, one of the same is")
{
    const ScratchFolder folder;
    const std::string line = reference_line("/a & b/r & r.dng");
    CHECK(line.rfind("Reference: r & r.dng, in the folder xxh64:", 0) == 0);
    CHECK(line.find('/') == std::string::npos);
    const std::string bake =
        folder.file("r.dng.unprocess.clf", "<Description>" + clf_escaped(line) + "</Description>\n");
    CHECK(failure_of([&] { refuse_bake_of_another(bake, "/a & b/r & r.dng"); }) == "");
    CHECK(failure_of([&] { refuse_bake_of_another(bake, "/c/r & r.dng"); }) ==
          "1: '" + bake +
              "' is the bake of another reference, of the same name, in another folder than '/c'; remove "
              "it, or give -o NAME");
    CHECK(failure_of([&] { refuse_bake_of_another(folder.path("none"), "/c/r.dng"); }) == "");
    CHECK(failure_of([&] { refuse_bake_of_another(folder.file("other", "text"), "/c/r.dng"); }) == "");
}
