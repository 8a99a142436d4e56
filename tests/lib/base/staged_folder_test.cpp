// SPDX-License-Identifier: Apache-2.0
#include "base/staged_folder.h"

#include <filesystem>

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;
namespace fs = std::filesystem;

static std::string refusal(const std::string& target, bool replace)
{
    const auto folder = StagedFolder::create(target, "mark", replace);
    return folder ? std::string() : folder.error().message;
}

TEST_CASE("a staged folder appears when it is published, with a slash at its end or without")
{
    const ScratchFolder scratch;
    for (const char* name : { "a", "b/" }) {
        const auto folder = StagedFolder::create(scratch.path(name), "mark", false);
        REQUIRE(folder);
        CHECK_FALSE(fs::exists(scratch.path(name)));
        CHECK((*folder)->publish());
        CHECK(fs::is_directory(scratch.path(name)));
    }
    CHECK(fs::exists(scratch.path("a")));
    CHECK(fs::exists(scratch.path("b")));
}

TEST_CASE("a staged folder replaces an empty folder, or one of its kind when asked for, and nothing else")
{
    const ScratchFolder scratch;
    const std::string target = scratch.path("t");
    CHECK(refusal(scratch.path("no/t"), true) ==
          "'" + scratch.path("no/t") + "' cannot be made: the folder '" + scratch.path("no") + "' does not exist");
    CHECK(refusal(scratch.file("file"), true) == "'" + scratch.path("file") + "' exists and is not a folder");
    fs::create_directory(target);
    CHECK(refusal(target, false).empty());
    scratch.file("t/precious");
    CHECK(refusal(target, true) == "'" + target + "' exists and holds no mark; it is not replaced");
    scratch.file("t/mark");
    CHECK(refusal(target, false) == "'" + target + "' exists already; --replace makes it anew");
    {
        const auto folder = StagedFolder::create(target, "mark", true);
        REQUIRE(folder);
        CHECK(fs::exists(target + "/precious"));
        CHECK((*folder)->publish());
        CHECK_FALSE(fs::exists(target + "/precious"));
    }
    CHECK(fs::is_empty(target));
}

TEST_CASE("what a killed program left of a staged folder goes with the next one, that of a living one stays")
{
    const ScratchFolder scratch;
    fs::create_directory(scratch.path(".t.partial-killed"));
    scratch.file(".t.partial-killed/x");
    fs::create_directory(scratch.path(".other.partial-killed"));
    const auto living = StagedFolder::create(scratch.path("t"), "mark", false);
    REQUIRE(living);
    CHECK_FALSE(fs::exists(scratch.path(".t.partial-killed")));
    CHECK(fs::exists(scratch.path(".other.partial-killed")));
    CHECK(refusal(scratch.path("t"), false).empty());
    CHECK(fs::exists((*living)->path()));
}
