// SPDX-License-Identifier: Apache-2.0
// Mosaic, noise and DNG on srisptool's line.
#include <doctest/doctest.h>

#include "../failure_of.h"
#include "rewritten.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

/// The job or recipe of the last of our commands.
nlohmann::json last_job(const std::vector<std::string>& words)
{
    const Rewritten result = rewritten(words);
    REQUIRE(!result.files.empty());
    return result.files.back().content;
}

} // namespace

TEST_CASE("mosaic and noise directly behind unprocess join its recipe: one pass over the pixels")
{
    const Files files;
    const Rewritten result =
        rewritten({ files.photo, "--srisp-unprocess:seed=3", files.reference, "--srisp-mosaic:phase=bggr",
                    "--srisp-noise:seed=7", "reference", "-o", "raw.exr" });
    CHECK(result.words == joined({ { kReadNow, "/T/1.srisp", "-o", "raw.exr" } }));
    REQUIRE(result.files.size() == 1);
    const nlohmann::json& recipe = result.files[0].content;
    CHECK(recipe["mosaic"] == "bggr");
    CHECK(recipe["noise"] == "reference");
    CHECK(recipe["noise_seed"] == 7);
    CHECK(recipe["seed"] == 3);
    CHECK(!recipe.contains("action"));
    CHECK(!recipe.contains("levels"));
}

TEST_CASE("with another command between them they are jobs of their own, and noise knows the line's reference")
{
    const Files files;
    const Rewritten result = rewritten({ files.photo, "--srisp-unprocess:seed=3", files.reference, "--resize", "50%",
                                         "--srisp-mosaic", "--flip", "--srisp-noise", "reference" });
    CHECK(result.words ==
          joined({ { kReadNow, "/T/1.srisp", "--resize", "50%" }, hand_over("2"), { "--flip" }, hand_over("3") }));
    CHECK(result.files[1].content["action"] == "sensor");
    CHECK(result.files[1].content["mosaic"] == "reference");
    CHECK(!result.files[1].content.contains("noise"));
    CHECK(result.files[2].content["action"] == "sensor");
    CHECK(result.files[2].content["noise"] == "reference");
    CHECK(result.files[2].content["reference"] == files.reference);
    CHECK(result.files[2].content["seed"] == 3);
}

TEST_CASE("a RAW-like file takes mosaic and noise in one recipe, without a reference")
{
    const Files files;
    const Rewritten result = rewritten({ files.photo, "--srisp-mosaic", "--srisp-noise", "upi" });
    CHECK(result.words == joined({ { kReadNow, "/T/1.srisp" } }));
    CHECK(result.files[0].content["action"] == "sensor");
    CHECK(!result.files[0].content.contains("reference"));
}

TEST_CASE("a mosaic has the camera's levels where integers are written, unless the user chose")
{
    const Files files;
    const auto levels = [&](std::vector<std::string> output, const std::string& mosaic = "--srisp-mosaic") {
        std::vector<std::string> words = { files.photo, mosaic };
        words.insert(words.end(), output.begin(), output.end());
        return last_job(words).value("levels", "");
    };
    CHECK(levels({ "-o", "x.png" }) == "camera");
    CHECK(levels({ "-d", "uint16", "-o", "x.tif" }) == "camera");
    CHECK(levels({ "-o:datatype=uint16", "x.tif" }) == "camera");
    CHECK(levels({ "-o", "x.exr", "-o", "x.png" }) == "camera");
    CHECK(levels({ "-o", "x.exr" }) == "");
    CHECK(levels({ "-o", "x.tif" }) == "");
    CHECK(levels({ "-d", "uint16", "-o:datatype=half", "x.exr" }) == "");
    CHECK(levels({ "-o", "x.dng" }) == ""); // has levels of its own
    CHECK(levels({ "-o", "x.png" }, "--srisp-mosaic:levels=unit") == "unit");
    CHECK(levels({ "-o", "x.exr" }, "--srisp-mosaic:levels=camera") == "camera");
}

TEST_CASE("options of a DNG are attributes for as long as it is written")
{
    const Files files;
    const auto words = [&](std::vector<std::string> rest, bool notes = true) {
        std::vector<std::string> line = { files.photo };
        line.insert(line.end(), rest.begin(), rest.end());
        return rewritten(line, { "/T", "", false, notes }).words;
    };
    const Words set_layout = { "--attrib:type=string", "dng:layout", "cinema" };
    const Words set_bits = { "--attrib:type=string", "dng:bits", "12" };
    const Words set_compression = { "--attrib:type=string", "compression", "none" };
    CHECK(words({ "-o:layout=cinema:bits=12:compression=none", "x.dng", "-v", "-o", "x.exr" }) ==
          joined({ { files.photo },
                   set_layout,
                   set_bits,
                   set_compression,
                   { "-o", "x.dng", "-v", "--eraseattrib", "dng:layout", "--eraseattrib", "dng:bits", "--eraseattrib",
                     "compression", "-o", "x.exr" } }));
    CHECK(words({ "-o", "x.dng" }, false) ==
          joined({ { files.photo, "--attrib:type=string", "dng:quiet", "1", "-o", "x.dng" } }));
    CHECK(words({ "-d", "half", "-o", "x.dng" }) ==
          joined({ { files.photo, "-d", "half", "--attrib:type=string", "dng:datatype", "half", "-o", "x.dng" } }));
    CHECK(
        words({ "-o:fileformatname=dng:datatype=float", "x.raw" }) ==
        joined({ { files.photo, "--attrib:type=string", "dng:datatype", "float", "-o:fileformatname=dng", "x.raw" } }));
    CHECK(words({ "-o", "x.DNG" }) == joined({ { files.photo, "-o", "x.DNG" } }));
}

TEST_CASE("slips in the arguments of mosaic and noise are wrong usage, before anything is read")
{
    const Files files;
    const auto failure = [&](std::vector<std::string> rest) {
        std::vector<std::string> line = { files.photo };
        line.insert(line.end(), rest.begin(), rest.end());
        return failure_of([&] { rewritten(line); });
    };
    CHECK(failure({ "--srisp-mosaic:phase=rggg" }) ==
          "2: --srisp-mosaic: unknown phase 'rggg'; known: reference, RGGB, GRBG, GBRG, BGGR");
    CHECK(failure({ "--srisp-mosaic:seed=1" }).find("unknown modifier 'seed'") != std::string::npos);
    CHECK(failure({ "--srisp-noise", "iso=abc" }) == "2: --srisp-noise: noise 'iso=abc': the ISO is a number above 0");
    CHECK(failure({ "--srisp-noise" }) == "2: --srisp-noise needs an argument: SOURCE");
    CHECK(failure({ "--srisp-noise:profile=/nowhere.json", "iso=100" }) ==
          "1: --srisp-noise: profile '/nowhere.json' does not exist");
}
