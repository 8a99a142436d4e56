// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/common/temporary_folder.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::tool;
namespace fs = std::filesystem;

namespace {

/// $TMPDIR for one test.
struct TemporaryBase {
    explicit TemporaryBase(const std::string& path) { setenv("TMPDIR", path.c_str(), 1); }
    ~TemporaryBase() { unsetenv("TMPDIR"); }
};

/// What a process leaves that is killed while it has a temporary folder; `outputs` goes into its list.
void leave_folder_behind(const std::string& outputs)
{
    const pid_t child = fork();
    if (child == 0) {
        const TemporaryFolder folder;
        std::ofstream(folder.path() / kStartedOutputs, std::ios::binary) << outputs << '\0';
        _exit(0);
    }
    waitpid(child, nullptr, 0);
}

std::size_t count(const std::string& folder)
{
    return std::size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

} // namespace

TEST_CASE("a temporary folder is private, lies in TMPDIR, and goes with what is in it")
{
    const ScratchFolder scratch;
    const TemporaryBase base(scratch.path());
    {
        const TemporaryFolder folder;
        CHECK(folder.path().parent_path() == scratch.path());
        struct stat info;
        REQUIRE(stat(folder.path().c_str(), &info) == 0);
        CHECK((info.st_mode & 0777) == 0700);
        fs::create_directory(folder.path() / "sub");
        std::ofstream(folder.path() / "sub/file") << "x";
    }
    CHECK(count(scratch.path()) == 0);
}

TEST_CASE("unfinished outputs that are listed go with the folder")
{
    const ScratchFolder scratch, outputs;
    const TemporaryBase base(scratch.path());
    const std::string unfinished = outputs.file("a b.0123abcd.temp.exr"), finished = outputs.file("a b.exr");
    {
        const TemporaryFolder folder;
        std::ofstream(folder.path() / kStartedOutputs, std::ios::binary)
            << unfinished << '\0' << outputs.path("gone") << '\0';
    }
    CHECK(!fs::exists(unfinished));
    CHECK(fs::exists(finished));
}

TEST_CASE("the next run removes what a killed run left, and its unfinished outputs")
{
    const ScratchFolder scratch, outputs;
    const TemporaryBase base(scratch.path());
    const std::string unfinished = outputs.file("a.0123abcd.temp.exr");
    leave_folder_behind(unfinished);
    REQUIRE(count(scratch.path()) == 1);
    const TemporaryFolder folder;
    CHECK(count(scratch.path()) == 1);
    CHECK(fs::exists(folder.path()));
    CHECK(!fs::exists(unfinished));
}

TEST_CASE("folders of runs that live, and folders of others, stay")
{
    const ScratchFolder scratch, outputs;
    const TemporaryBase base(scratch.path());
    const TemporaryFolder living;
    const std::string unfinished = outputs.file("a.0123abcd.temp.exr");
    for (const char* name : { "srisptool-notes", "srisptool-1-ABCdef", ".srisptool.partial-0123456789abcdef" }) {
        fs::create_directory(scratch.path(name));
        fs::permissions(scratch.path(name), fs::perms::owner_all);
        scratch.file(name + std::string("/lock"));
        scratch.file(name + std::string("/") + kStartedOutputs, unfinished + '\0');
    }
    const TemporaryFolder folder;
    CHECK(fs::exists(living.path()));
    CHECK(count(scratch.path()) == 5);
    CHECK(fs::exists(unfinished));
}

TEST_CASE("of what a leftover lists nothing goes but files of this user under names that oiiotool made")
{
    const ScratchFolder scratch, outputs;
    const TemporaryBase base(scratch.path());
    const std::string photo = outputs.file("photo.jpg"), link = outputs.path("b.0123abcd.temp.exr"),
                      folder = outputs.path("c.0123abcd.temp.exr"), inside = outputs.path("d.0123abcd.temp.exr/photo");
    fs::create_symlink(photo, link);
    fs::create_directory(folder);
    fs::create_directory(fs::path(inside).parent_path());
    outputs.file("d.0123abcd.temp.exr/photo");
    leave_folder_behind(photo + '\0' + link + '\0' + folder + '\0' + inside + '\0' + '\0' + outputs.path("gone"));
    REQUIRE(count(scratch.path()) == 1);
    {
        const TemporaryFolder next;
        CHECK(count(scratch.path()) == 1);
    }
    for (const std::string& path : { photo, link, folder, inside })
        CHECK(fs::exists(path));
}

TEST_CASE("a leftover that others may write to is not touched, and a pipe in one is not waited for")
{
    const ScratchFolder scratch, outputs;
    const TemporaryBase base(scratch.path());
    const std::string unfinished = outputs.file("a.0123abcd.temp.exr");
    leave_folder_behind(unfinished);
    const fs::path left = *fs::directory_iterator(scratch.path());
    fs::permissions(left, fs::perms::all);
    CHECK(count(TemporaryFolder().path().parent_path()) == 2);
    CHECK(fs::exists(unfinished));
    fs::permissions(left, fs::perms::owner_all);
    fs::remove(left / kStartedOutputs);
    REQUIRE(mkfifo((left / kStartedOutputs).c_str(), 0600) == 0);
    const TemporaryFolder next;
    CHECK(count(scratch.path()) == 1);
}

TEST_CASE("a TMPDIR whose name oiiotool would scan is not used")
{
    const ScratchFolder scratch;
    for (const char* name : { "a#b", "a@b", "a%04d", "{x}", "a?b", "a b", "a:b" }) {
        fs::create_directory(scratch.path(name));
        const TemporaryBase base(scratch.path(name));
        const TemporaryFolder folder;
        CHECK(folder.path().parent_path() == "/tmp");
    }
}

TEST_CASE("a TMPDIR that is missing is not used")
{
    const TemporaryBase base("/no/such/folder");
    const TemporaryFolder folder;
    CHECK(folder.path().parent_path() == "/tmp");
}
