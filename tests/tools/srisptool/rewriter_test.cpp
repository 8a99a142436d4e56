// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisptool/rewriter.h"

#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "../failure_of.h"
#include "rewritten.h"

using namespace srisp;
using namespace srisp::tool;

TEST_CASE("a plain file name before unprocess becomes a recipe")
{
    const Files files;
    const Rewritten result = rewritten({ files.photo, "--srisp-unprocess:seed=3", files.reference, "-o", "raw.exr" });
    CHECK(result.words == joined({ { kReadNow, "/T/1.srisp", "-o", "raw.exr" } }));
    REQUIRE(result.files.size() == 1);
    CHECK(result.files[0].name == "1.srisp");
    CHECK(result.files[0].content == nlohmann::json{ { "format", "srisp-recipe-1" },
                                                     { "direction", "reverse" },
                                                     { "source", files.photo },
                                                     { "reference", files.reference },
                                                     { "seed", 3 },
                                                     { "progress", false },
                                                     { "notes", false } });
    CHECK(result.warnings.empty());
}

TEST_CASE("-i without modifiers is as good as a plain name")
{
    const Files files;
    CHECK(rewritten({ "-i", files.photo, "--srisp-process" }).words == joined({ { kReadNow, "/T/1.srisp" } }));
    CHECK(rewritten({ "-i:ch=R,G,B", files.photo, "--srisp-process" }).words ==
          joined({ { "-i:ch=R,G,B:now=1", "/T/1.srisp" }, hand_over("2") }));
}

TEST_CASE("an image that was worked on is handed over")
{
    const Files files;
    const Rewritten result = rewritten({ files.photo, "--resize", "50%", "--srisp-unprocess:hold=1", files.reference });
    CHECK(result.words == joined({ { kReadNow, "/T/1.srisp", "--resize", "50%" }, hand_over("2") }));
    CHECK(result.files[1].name == "2.json");
    CHECK(result.files[1].content == nlohmann::json{ { "format", "srisp-recipe-1" },
                                                     { "direction", "reverse" },
                                                     { "action", "apply" },
                                                     { "reference", files.reference },
                                                     { "hold", true },
                                                     { "name", files.photo },
                                                     { "progress", false },
                                                     { "notes", false } });
}

TEST_CASE("every file that is read before the last of our commands is read through a recipe")
{
    const Files files;
    const Rewritten result = rewritten({ "-v", files.photo, "-i:now=1", files.other, "--over", "--srisp-unprocess",
                                         files.reference, files.photo, "--over", "-o", "x.exr" });
    CHECK(result.words == joined({ { "-v", kReadNow, "/T/1.srisp", "-i:now=1", "/T/2.srisp", "--over" },
                                   hand_over("3"),
                                   { files.photo, "--over", "-o", "x.exr" } }));
    CHECK(result.files[0].name == "1.srisp");
    CHECK(result.files[0].content ==
          nlohmann::json{
              { "format", "srisp-recipe-1" }, { "action", "read" }, { "source", files.photo }, { "notes", false } });
    CHECK(result.files[1].content["source"] == files.other);
}

TEST_CASE("in a loop a file is read before our command, too, when it stands behind it")
{
    const Files files;
    const Words words =
        rewritten({ files.photo, "--for", "i", "2", "--srisp-process", files.other, "--endfor", files.photo, "--over" })
            .words;
    CHECK(words == joined({ { kReadNow, "/T/1.srisp", "--for", "i", "2" },
                            hand_over("2"),
                            { kReadNow, "/T/3.srisp", "--endfor", files.photo, "--over" } }));
}

TEST_CASE("what is printed of each image bears the user's name, and the recipe takes its place")
{
    const Files files;
    for (const char* option : { "--info", "-stats", "--hash", "--dumpdata" })
        CHECK(rewritten({ option, files.photo, "--srisp-process" }).words ==
              joined({ { option, files.photo, kIn, "/T/1.srisp", "--swap", "--pop" }, hand_over("2") }));
    CHECK(rewritten({ "-i:info=2:ch=R", files.photo, "--srisp-process" }).words ==
          joined({ { "-i:info=2:ch=R", files.photo, "-i:info=2:ch=R:now=1:autocc=0:info=0", "/T/1.srisp", "--swap",
                     "--pop" },
                   hand_over("2") }));
    CHECK(rewritten({ "--info", "--over", files.photo, "--srisp-process" }).words ==
          joined({ { "--info", "--over", files.photo }, hand_over("1") }));
}

TEST_CASE("where names of images on the stack may be printed they stay the user's")
{
    const Files files;
    for (const Words& step : std::vector<Words>{
             { "--printinfo" }, { "--diff" }, { "--echo", "{TOP.filename}" }, { "-o", "{TOP.file_extension}" } }) {
        Words words = { files.photo, "--flip", "--srisp-process" };
        words.insert(words.end(), step.begin(), step.end());
        CHECK(rewritten(words).words == joined({ { files.photo, "--flip" }, hand_over("1"), step }));
    }
}

TEST_CASE("the frame wildcard of a sequence stays in the name that takes its place")
{
    const ScratchFolder scratch;
    for (const char* name : { "s.0001.tif", "s.0002.tif", "s.x.tif", "s..tif", "s.0003.tiff" })
        scratch.file(name);
    const Rewritten result = rewritten({ scratch.path("s.#.tif"), "--flip", "--srisp-process" });
    CHECK(result.words == joined({ { kReadNow, "/T/1.#.srisp", "--flip" }, hand_over("2") }));
    REQUIRE(result.files.size() == 4);
    CHECK(result.files[0].name == "1.json");
    CHECK(result.files[0].content["action"] == "read");
    CHECK(result.files[0].content["source"] == scratch.path("s.%04d.tif"));
    CHECK(std::set<std::string>{ result.files[1].name, result.files[2].name } ==
          std::set<std::string>{ "1.0001.srisp", "1.0002.srisp" });
    CHECK(result.files[1].content == nlohmann::json{ { "format", "srisp-slot-1" } });
    CHECK(rewritten({ scratch.path("s.%04d.tif"), "--flip", "--srisp-process" }).words[2] == "/T/1.%04d.srisp");

    const Rewritten range = rewritten({ scratch.path("t.1-9@@.tif"), "--srisp-process" });
    CHECK(range.words == joined({ { kReadNow, "/T/1.1-9@@.srisp" } }));
    REQUIRE(range.files.size() == 1);
    CHECK(range.files[0].name == "1.json");
    CHECK(range.files[0].content["source"] == scratch.path("t.%02d.tif"));
    CHECK(rewritten({ "--frames", "1-2", scratch.path("t.#.tif"), "--srisp-process" }).words.back() == "/T/1.#.srisp");
}

TEST_CASE("sequences that only oiiotool can name stay as they are")
{
    const ScratchFolder scratch;
    scratch.file("s.00001.tif");
    const std::string sequence = scratch.path("s.#.tif");
    for (const Words& words : std::vector<Words>{ { scratch.path("t.#.tif") },
                                                  { scratch.path("1-2#/s.1-2#.tif") },
                                                  { "--framepadding", "5", sequence },
                                                  { scratch.path("s.%V.#.tif") } }) {
        Words all = words;
        all.push_back("--srisp-process");
        CHECK(rewritten(all).words == joined({ words, hand_over("1") }));
    }
}

TEST_CASE("messages can say what a temporary name stands for")
{
    const Files files;
    const Rewritten result =
        rewritten({ files.photo, "--srisp-params", files.reference, "x.1-2#.tif", "--srisp-process" });
    CHECK(result.subjects.size() == 3);
    CHECK(result.subjects.at("1").path == files.photo);
    CHECK(result.subjects.at("1").image == files.photo);
    CHECK(result.subjects.at("1").command == "");
    CHECK(result.subjects.at("2").command == "--srisp-params");
    CHECK(result.subjects.at("2").path == "");
    CHECK(result.subjects.at("3").image == "x.1-2#.tif");
    CHECK(result.subjects.at("3").sequence);
    CHECK(result.subjects.at("3").command == "--srisp-process");
}

TEST_CASE("commands one after the other get numbers of their own")
{
    const Files files;
    const Rewritten result =
        rewritten({ files.photo, "--srisp-unprocess", files.reference, files.other, "--srisp-unprocess",
                    files.reference, "--over", "--srisp-process", "-o", "x.exr" });
    CHECK(result.words ==
          joined({ { kReadNow, "/T/1.srisp", kReadNow, "/T/2.srisp", "--over" }, hand_over("3"), { "-o", "x.exr" } }));
    CHECK(result.files[2].content["direction"] == "forward");
}

TEST_CASE("process directly after unprocess is handed over")
{
    const Files files;
    CHECK(rewritten({ files.photo, "--srisp-unprocess", files.reference, "--srisp-process" }).words ==
          joined({ { kReadNow, "/T/1.srisp" }, hand_over("2") }));
}

TEST_CASE("printing and saving parameters leave the image on the stack")
{
    const Files files;
    const Rewritten result =
        rewritten({ files.photo, "--srisp-params", files.reference, "--srisp-unprocess", files.reference,
                    "--srisp-save-params", files.scratch.path("p.#.json"), "-o", "raw.exr" });
    CHECK(result.words == joined({ { kReadNow, "/T/1.srisp", kOut, "/T/2.{FRAME_NUMBER}.srisp" },
                                   hand_over("3"),
                                   { kOut, "/T/4.{FRAME_NUMBER}.srisp", "-o", "raw.exr" } }));
    CHECK(result.files[1].content["action"] == "print");
    CHECK(result.files[3].content["action"] == "save");
    CHECK(result.files[3].content["file"] == files.scratch.path("p.%04d.json"));
}

TEST_CASE("where evaluation is off it is turned on for the hand-over only")
{
    const Files files;
    CHECK(rewritten({ "--evaloff", files.photo, "--flip", "--srisp-unprocess", files.reference, "-o", "{x}.exr" })
              .words == joined({ { "--evaloff", kReadNow, "/T/1.srisp", "--flip", "--evalon" },
                                 hand_over("2"),
                                 { "--evaloff", "-o", "{x}.exr" } }));
    CHECK(rewritten({ "-evaloff", "-evalon", files.photo, "--flip", "--srisp-process" }).words ==
          joined({ { "-evaloff", "-evalon", kReadNow, "/T/1.srisp", "--flip" }, hand_over("2") }));
}

TEST_CASE("what changes how images are read forbids to unprocess the file itself")
{
    const Files files;
    const auto words_behind = [&](Words words) {
        for (const std::string& word : { files.photo, std::string("--srisp-unprocess"), files.reference })
            words.push_back(word);
        return rewritten(words).words;
    };
    for (const Words& before : std::vector<Words>{ { "--iconfig", "a", "b" },
                                                   { "--no-autopremult" },
                                                   { "--autocc", "--noautocc" },
                                                   { "--over" },
                                                   { "--if", "1" },
                                                   { "--newer-than-2.4" } }) {
        CAPTURE(before[0]);
        CHECK(words_behind(before) == joined({ before, { kReadNow, "/T/1.srisp" }, hand_over("2") }));
    }
    for (const Words& before : std::vector<Words>{ { "--autocc" }, { "--native" }, { "--missingfile", "black" } }) {
        CAPTURE(before[0]);
        CHECK(words_behind(before) == joined({ before, { files.photo }, hand_over("1") }));
    }
    CHECK(rewritten({ "-i:autocc=1", files.photo, "--srisp-process" }).words ==
          joined({ { "-i:autocc=1", files.photo }, hand_over("1") }));
}

TEST_CASE("options that change nothing of reading do not")
{
    const Files files;
    CHECK(rewritten({ "-v", "--threads", "2", "-a", "--frames", "1-3", files.photo, "--srisp-process" }).words ==
          joined({ { "-v", "--threads", "2", "-a", "--frames", "1-3", kReadNow, "/T/1.srisp" } }));
}

TEST_CASE("wildcards without files, expressions, queries, labels, recipes and missing files stay with oiiotool")
{
    const Files files;
    for (const char* name : { "a#.jpg", "a@.jpg", "a%04d.jpg", "a%V.jpg", "{x}.jpg", "a.jpg?x=1", "a.srisp" }) {
        CAPTURE(name);
        const std::string photo = files.scratch.file(name);
        CHECK(rewritten({ photo, "--srisp-process" }).words == joined({ { photo }, hand_over("1") }));
    }
    CHECK(rewritten({ "no.jpg", "--srisp-process" }).words == joined({ { "no.jpg" }, hand_over("1") }));
    CHECK(rewritten({ "x.tif", "--label", files.photo, files.photo, "--srisp-process" }).words.back() ==
          "/T/1.{FRAME_NUMBER}.srisp");
}

TEST_CASE("arguments of other commands are not taken for images")
{
    const Files files;
    CHECK(rewritten({ "x.tif", "--text", files.photo, "--srisp-process" }).words ==
          joined({ { "x.tif", "--text", files.photo }, hand_over("1") }));
}

TEST_CASE("names of the user never stand in words that srisptool adds")
{
    const ScratchFolder scratch;
    const std::string photo = scratch.file("50%20d #@{1}=&?.jpg"), reference = scratch.file("r%04d{x}#.dng");
    const Rewritten result = rewritten({ photo, "--srisp-unprocess", reference, "--srisp-params", reference });
    CHECK(result.words == joined({ { photo }, hand_over("1"), { kOut, "/T/2.{FRAME_NUMBER}.srisp" } }));
    CHECK(result.files[0].content["reference"] == reference);
    const Rewritten literal = rewritten(
        { "--wildcardoff", "--evaloff", scratch.file("%V#@{1}=&.jpg"), "--flip", "--srisp-unprocess", reference });
    CHECK(literal.words == joined({ { "--wildcardoff", "--evaloff", kReadNow, "/T/1.srisp", "--flip", "--evalon" },
                                    hand_over("2"),
                                    { "--evaloff" } }));
    CHECK(literal.files[0].content["source"] == scratch.path("%V#@{1}=&.jpg"));
}

TEST_CASE("a job knows what its image is called, with the frame wildcard as printf has it")
{
    const auto name = [](const Words& words) { return rewritten(words).files[0].content["name"]; };
    CHECK(name({ "s.#.tif", "--srisp-process" }) == "s.%04d.tif");
    CHECK(name({ "--wildcardoff", "s.#.tif", "--srisp-process" }) == "s.#.tif");
    CHECK(name({ "a.tif", "-i:ch=R", "b.tif", "--srisp-process" }) == "b.tif");
    CHECK(!rewritten({ "a.tif", "--create", "1x1", "3", "--srisp-process" }).files[0].content.contains("name"));
}

TEST_CASE("formats without float get 16 bits for RAW-like images, unless the user chose")
{
    const Files files;
    const auto last = [&](Words words) {
        words.insert(words.begin(), { files.photo, "--srisp-unprocess", files.reference });
        const Words all = rewritten(words).words;
        return Words(all.end() - 2, all.end());
    };
    CHECK(last({ "-o", "x.png" }) == Words{ "-o:datatype=uint16", "x.png" });
    CHECK(last({ "-o:dither=1", "x.#.PNG" }) == Words{ "-o:dither=1:datatype=uint16", "x.#.PNG" });
    CHECK(last({ "-o:fileformatname=png", "x" }) == Words{ "-o:fileformatname=png:datatype=uint16", "x" });
    CHECK(last({ "-o:fileformatname=openexr", "x.png" }) == Words{ "-o:fileformatname=openexr", "x.png" });
    CHECK(last({ "-o:datatype=uint8", "x.png" }) == Words{ "-o:datatype=uint8", "x.png" });
    CHECK(last({ "-o:bits=10", "x.png" }) == Words{ "-o:bits=10", "x.png" });
    CHECK(last({ "-d", "uint8", "-o", "x.png" }) == Words{ "-o", "x.png" });
    CHECK(last({ "-o", "x.exr" }) == Words{ "-o", "x.exr" });
    CHECK(last({ "--srisp-process", "-o", "x.png" }) == Words{ "-o", "x.png" });
    const Words before = rewritten({ files.photo, "-o", "x.png", "--srisp-unprocess", files.reference }).words;
    CHECK(std::count(before.begin(), before.end(), "-o") == 1);
}

TEST_CASE("formats of 8 bits get a warning that names -d, once the user did not choose")
{
    const Files files;
    const Rewritten result = rewritten({ files.photo, "--srisp-unprocess", files.reference, "-o", "x.jpg" });
    REQUIRE(result.warnings.size() == 1);
    CHECK(result.warnings[0].find("'x.jpg' holds 8 bits") == 0);
    CHECK(result.warnings[0].find("-d uint8") != std::string::npos);
    CHECK(rewritten({ files.photo, "--srisp-unprocess", files.reference, "-d", "uint8", "-o", "x.jpg" })
              .warnings.empty());
}

TEST_CASE("a dry run reads recipes, and skips what would need to write")
{
    const Files files;
    CHECK(rewritten({ "-n", files.photo, "--srisp-process" }).words == joined({ { "-n", "/T/1.srisp" } }));
    const Rewritten result = rewritten({ "-n", files.photo, "--flip", "--srisp-process" });
    CHECK(result.words == joined({ { "-n", "/T/1.srisp", "--flip" } }));
    CHECK(result.warnings.size() == 1);
}

TEST_CASE("the user's command line and the progress go into every job")
{
    const Files files;
    const Rewritten result =
        rewritten({ files.photo, "--srisp-process", "--srisp-process" }, { "/T", "srisptool x", true, false });
    for (const JobFile& file : result.files) {
        CHECK(file.content["command"] == "srisptool x");
        CHECK(file.content["progress"] == true);
    }
}

TEST_CASE("--quiet and --no-progress are ours: oiiotool gets its -q")
{
    const Files files;
    CHECK(rewritten({ "--quiet", "--no-progress", files.photo, "--srisp-process" }).words ==
          joined({ { "-q", kReadNow, "/T/1.srisp" } }));
}

TEST_CASE("a command of oiiotool's that lacks an argument is refused before anything is done")
{
    CHECK(failure_of([] {
              rewritten({ "a.jpg", "--srisp-process", "--tile", "64" });
          }) == "2: --tile lacks an argument");
    CHECK(failure_of([] { rewritten({ "a.jpg", "--srisp-process", "-i" }); }) == "2: -i lacks an argument");
}

TEST_CASE("without an image there is nothing to do")
{
    const Files files;
    CHECK(failure_of([&] {
              rewritten({ "--srisp-unprocess", files.reference, "-o", "x.exr" });
          }) == "1: --srisp-unprocess: no image before it");
    CHECK(failure_of([&] { rewritten({ "--create", "1x1", "3", "--srisp-process" }); }) == "");
}
