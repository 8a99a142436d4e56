// SPDX-License-Identifier: Apache-2.0
#include "base/staged_folder.h"

#include <filesystem>
#include <fstream>

#include <sys/wait.h>
#include <unistd.h>

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;
namespace fs = std::filesystem;

/// Folders with a file 'mark', and perhaps one 'other'.
static Status has_mark(const std::string& folder)
{
    if (!fs::exists(folder + "/mark"))
        return Error{ "holds no mark" };
    return fs::exists(folder + "/precious") ? Status(Error{ "holds 'precious'" }) : Status();
}

static std::string refusal(const std::string& target, bool replace)
{
    const auto folder = StagedFolder::create(target, has_mark, replace);
    return folder ? std::string() : folder.error().message;
}

TEST_CASE("a staged folder appears when it is published, with a slash at its end or without")
{
    const ScratchFolder scratch;
    for (const char* name : { "a", "b/" }) {
        const auto folder = StagedFolder::create(scratch.path(name), has_mark, false);
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
    CHECK(refusal(target, true) == "'" + target + "' exists and holds 'precious'; it is not replaced");
    fs::rename(target + "/precious", target + "/other");
    CHECK(refusal(target, false) == "'" + target + "' exists already; --replace makes it anew");
    {
        const auto folder = StagedFolder::create(target, has_mark, true);
        REQUIRE(folder);
        CHECK(fs::exists(target + "/other"));
        CHECK((*folder)->publish());
        CHECK_FALSE(fs::exists(target + "/other"));
    }
    CHECK(fs::is_empty(target));
}

TEST_CASE("a folder that others add to meanwhile is not replaced")
{
    const ScratchFolder scratch;
    const std::string target = scratch.path("t");
    fs::create_directory(target);
    scratch.file("t/mark");
    const auto folder = StagedFolder::create(target, has_mark, true);
    REQUIRE(folder);
    scratch.file("t/precious");
    const Status published = (*folder)->publish();
    REQUIRE_FALSE(published);
    CHECK(published.error().message == "'" + target + "' exists and holds 'precious'; it is not replaced");
    CHECK(fs::exists(target + "/precious"));
}

TEST_CASE("what a killed program left of a staged folder goes with the next one; what lives and what is a user's stays")
{
    const ScratchFolder scratch;
    const auto make = [&] { return StagedFolder::create(scratch.path("t"), has_mark, false); };
    const pid_t child = fork();
    if (child == 0) {
        const auto left = make();
        std::ofstream((*left)->path() + "/x") << "x";
        _exit(left ? 0 : 1);
    }
    waitpid(child, nullptr, 0);
    REQUIRE(std::distance(fs::directory_iterator(scratch.path()), {}) == 1);
    const std::string left = fs::directory_iterator(scratch.path())->path().string();
    for (const char* name : { ".t.partial-mine", ".t.partial-0123456789abcdef", ".other.partial-0123456789abcdef" }) {
        fs::create_directory(scratch.path(name));
        scratch.file(name + std::string("/x"));
    }
    const auto living = make();
    REQUIRE(living);
    CHECK_FALSE(fs::exists(left));
    CHECK(refusal(scratch.path("t"), false).empty());
    CHECK(fs::exists((*living)->path()));
    CHECK(std::distance(fs::directory_iterator(scratch.path()), {}) == 4);
}
