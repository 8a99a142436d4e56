// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispbake/config_fragment.h"

#include <doctest/doctest.h>

#include <sstream>

#include <OpenColorIO/OpenColorIO.h>

#include "../../../tools/srispbake/linear_srgb.h"
#include "../failure_of.h"
#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::tool;
namespace OCIO = OCIO_NAMESPACE;

namespace {

const char kHead[] = "ocio_profile_version: 2\n";
const char kStudio[] = R"(search_path: luts
strictparsing: true
name: studio   # our house config
roles:
  aces_interchange: ACES2065-1
  default: ACES2065-1
  scene_linear: ACEScg
file_rules:
- !<Rule> {name: Default, colorspace: default}
displays:
  d:
  - !<View> {name: v, colorspace: ACEScg}
# the looks
looks:
- !<Look>
  name: warm
  process_space: ACEScg
  transform: !<CDLTransform> {slope: [1.1, 1, 0.9]}

# the spaces
colorspaces:
- !<ColorSpace>
  name: ACES2065-1
# a comment inside
- !<ColorSpace>
  name: ACEScg
  to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}
)";
const char kShot[] = "environment:\n  SHOT: a\n";

std::string text_of(const std::string& path)
{
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// The lines of `all` that are left when those of `part` are taken out in order; fails if one of `part` is missing.
std::string added_lines(const std::string& part, const std::string& all)
{
    std::istringstream a(part), b(all);
    std::string added, wanted, line;
    bool more = bool(std::getline(a, wanted));
    while (std::getline(b, line))
        if (more && line == wanted)
            more = bool(std::getline(a, wanted));
        else
            added += line + "\n";
    CHECK_MESSAGE(!more, "missing: ", wanted);
    return added;
}

} // namespace

TEST_CASE("a config gets the looks and colour spaces, and every line that it had stays")
{
    const ScratchFolder folder;
    const std::string original = std::string(kHead) + kShot + kStudio;
    const std::string config = folder.file("studio.ocio", original);
    const FragmentReport report = add_fragment(config, "", "");
    CHECK(report.linear_srgb == "aces_interchange");
    CHECK(report.neutral_folder == folder.path("luts"));
    CHECK(std::filesystem::exists(folder.path("luts/srisp_neutral.process.clf")));
    const std::string added = added_lines(original, text_of(config));
    CHECK(added.rfind("  SRISP_MODEL: default\n  SRISP_REFERENCE: srisp_neutral\n  SRISP_SOURCE: \"\"\n", 0) == 0);
    CHECK(added.find("name: srisp camera RGB") != std::string::npos);

    const auto loaded = OCIO::Config::CreateFromFile(config.c_str());
    loaded->validate();
    // Neutral, so camera RGB is linear sRGB: sRGB green in ACEScg, by way of the camera, is green by way of ACES.
    float by_camera[] = { 0, 0.5f, 0 }, direct[] = { 0, 0.5f, 0 };
    loaded->getProcessor("srisp sRGB", "srisp camera RGB")->getDefaultCPUProcessor()->applyRGB(by_camera);
    CHECK(by_camera[1] == doctest::Approx(0.21404).epsilon(1e-4));
    loaded->getProcessor("srisp camera RGB", "ACEScg")->getDefaultCPUProcessor()->applyRGB(by_camera);
    loaded->getProcessor("srisp sRGB", "ACEScg")->getDefaultCPUProcessor()->applyRGB(direct);
    for (int c = 0; c < 3; ++c)
        CHECK(by_camera[c] == doctest::Approx(direct[c]).epsilon(1e-4));

    const std::string once = text_of(config);
    CHECK(add_fragment(config, "", "").config.empty());
    CHECK(text_of(config) == once);
}

TEST_CASE("linear sRGB is found with the published matrix to ACES2065-1")
{
    const ScratchFolder folder;
    const auto config = OCIO::Config::CreateFromFile(folder.file("c.ocio", std::string(kHead) + kStudio).c_str());
    const double published[] = { 0.4396329819, 0.3829886982, 0.1773783199, 0.0897764431, 0.8134394286,
                                 0.0967841284, 0.0175411704, 0.1115465501, 0.8709122795 };
    const LinearSrgb found = find_linear_srgb(config, "");
    for (int i = 0; i < 9; ++i)
        CHECK(found.to_reference[std::size_t(i)] == doctest::Approx(published[i]).epsilon(1e-3));
}

TEST_CASE("an environment section is added to, and never made")
{
    const ScratchFolder folder;
    const std::string original = std::string(kHead) + kStudio, config = folder.file("c.ocio", original);
    const FragmentReport report = add_fragment(config, folder.path("out.ocio"), "ACEScg");
    CHECK(!report.environment_section);
    CHECK(text_of(folder.path("out.ocio")).find("environment:") == std::string::npos);
    CHECK(text_of(config) == original); // -o: the config itself stays
    CHECK(fragment_text(report).find("always set SRISP_REFERENCE") != std::string::npos);
}

TEST_CASE("a config in the form of OpenColorIO's built-in ones, without a search path, gets one")
{
    const std::string rest = std::string(kStudio).substr(std::string(kStudio).find('\n') + 1);
    for (const char* path : { "search_path: \"\"\n", "" }) {
        const ScratchFolder folder;
        const std::string config =
            folder.file("c.ocio", "ocio_profile_version: 2.1\n\nenvironment:\n  {}\n" + std::string(path) + rest);
        const FragmentReport report = add_fragment(config, "", "");
        CHECK(!report.search_path);
        CHECK(fragment_text(report).find("is '.' now") != std::string::npos);
        CHECK(added_lines(rest, text_of(config)).find("search_path: .\n") != std::string::npos);
        const auto loaded = OCIO::Config::CreateFromFile(config.c_str());
        loaded->validate();
        float rgb[] = { 0.5f, 0.5f, 0.5f };
        loaded->getProcessor("srisp sRGB", "srisp camera RGB")->getDefaultCPUProcessor()->applyRGB(rgb);
        CHECK(rgb[1] == doctest::Approx(0.21404).epsilon(1e-4)); // the neutral bake, found in the config's folder
    }
}

TEST_CASE("variables that the config declares keep their values")
{
    const ScratchFolder folder;
    const std::string original = std::string(kHead) +
                                 "environment: {SRISP_REFERENCE: srisp_neutral, SRISP_MODEL: m, SRISP_SOURCE: s}\n" +
                                 kStudio;
    const std::string config = folder.file("c.ocio", original);
    add_fragment(config, "", "");
    CHECK(OCIO::Config::CreateFromFile(config.c_str())->getEnvironmentVarDefault("SRISP_MODEL") == std::string("m"));
}

TEST_CASE("the looks are those of our own config")
{
    const ScratchFolder folder;
    const std::string path = folder.file("c.ocio", std::string(kHead) + kShot + kStudio);
    add_fragment(path, "", "");
    const auto config = OCIO::Config::CreateFromFile(path.c_str());
    const auto own =
        OCIO::Config::CreateFromFile((std::filesystem::path(SRISP_SOURCE_DIR) / "configs/ocio/srisp.ocio").c_str());
    const auto source = [](const OCIO::ConstTransformRcPtr& transform) {
        const auto file = std::dynamic_pointer_cast<const OCIO::FileTransform>(transform);
        return file ? std::string(file->getSrc()) : "";
    };
    for (const char* name : { "srisp unprocess", "srisp process" }) {
        const auto look = config->getLook(name), expected = own->getLook(name);
        REQUIRE((look && expected));
        CHECK(source(look->getTransform()) == source(expected->getTransform()));
        CHECK(source(look->getInverseTransform()) == source(expected->getInverseTransform()));
        CHECK(source(look->getTransform()) != source(look->getInverseTransform()));
    }
}

TEST_CASE("what cannot be extended is said, and nothing is written")
{
    const ScratchFolder folder;
    const auto failure = [&](const std::string& text, const std::string& linear = "") {
        const std::string config = folder.file("bad.ocio", text);
        const std::string message = failure_of([&] { add_fragment(config, "", linear); });
        CHECK(text_of(config) == text);
        CHECK(!std::filesystem::exists(folder.path("luts")));
        const std::string start = "1: config '" + config + "': ";
        CHECK(message.rfind(start, 0) == 0);
        return message.substr(std::min(message.size(), start.size()));
    };
    CHECK(
        failure("ocio_profile_version: 1\nroles: {default: lin}\ndisplays:\n  d:\n    - !<View> {name: v, colorspace: "
                "lin}\ncolorspaces:\n  - !<ColorSpace>\n    name: lin\n")
            .find("has profile version 1;") == 0);
    CHECK(failure("") != "");
    CHECK(failure("{").find("rror") != std::string::npos);
    CHECK(failure(std::string(kHead) + kStudio, "ACEScgg").find("did you mean 'ACEScg'?") != std::string::npos);
    std::string taken = std::string(kHead) + kStudio;
    taken.replace(taken.find("name: warm"), 10, "name: srisp process");
    CHECK(failure(taken).find("'srisp process' already") != std::string::npos);
    std::string nameless = std::string(kHead) + kStudio;
    nameless.replace(nameless.find("  aces_interchange: ACES2065-1\n"), 31, "");
    CHECK(failure(nameless).find("--linear-srgb NAME") != std::string::npos);
    std::string quoted = std::string(kHead) + kStudio; // OpenColorIO quotes names
    quoted.replace(quoted.find("process_space: ACEScg"), 21, "process_space: \"no\\n\\asuch\"");
    const std::string reason = failure(quoted);
    CHECK(reason.find("such") != std::string::npos);
    CHECK(reason.find_first_of("\n\a") == std::string::npos);
    CHECK(failure_of([&] { add_fragment(folder.path("no.ocio"), "", ""); }).find("no.ocio") != std::string::npos);
}
