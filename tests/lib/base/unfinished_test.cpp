// SPDX-License-Identifier: Apache-2.0
#include "base/unfinished.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <vector>

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;
namespace fs = std::filesystem;

namespace {

std::string base_name(const fs::path& path)
{
    return path.filename().string();
}

std::vector<std::string> leftovers(const fs::path& target)
{
    std::vector<std::string> names;
    for_each_leftover(target, [&](const fs::path& path) { names.push_back(base_name(path)); });
    return names;
}

} // namespace

TEST_CASE("an unfinished name is hidden, lies beside its target, and has the target's extension")
{
    const fs::path name = unfinished_name("some/folder/a b.clf");
    CHECK(name.parent_path() == "some/folder");
    CHECK(base_name(name).rfind(".a b.partial-", 0) == 0);
    CHECK(name.extension() == ".clf");
    CHECK(unfinished_name("some/folder/a b.clf") != name);
}

TEST_CASE("only what unfinished_name makes of a target is an unfinished name of it")
{
    const std::string name = base_name(unfinished_name("x/pack"));
    CHECK(is_unfinished_name(name, "pack"));
    CHECK(is_unfinished_name(name, "y/pack"));
    CHECK_FALSE(is_unfinished_name(name, "pack2"));
    CHECK_FALSE(is_unfinished_name(name + "0", "pack"));
    std::string other = name;
    other.back() = other.back() == '0' ? '1' : '0';
    CHECK_FALSE(is_unfinished_name(other, "pack"));
    for (const char* users : { ".pack.partial-", ".pack.partial-mine", ".pack.partial-0123456789abcdef", "pack", "" })
        CHECK_FALSE(is_unfinished_name(users, "pack"));
    const std::string longest(255, 'n');
    CHECK(base_name(unfinished_name(longest)).size() == 255);
    CHECK(is_unfinished_name(base_name(unfinished_name(longest)), longest));
    CHECK(fs::path(unfinished_name("a." + std::string(200, 'e'))).extension() != "." + std::string(200, 'e'));
    CHECK(fs::path(unfinished_name("a.png")).extension() == ".png");
}

TEST_CASE("what is unfinished is locked while its descriptor is open, and is a leftover then")
{
    const ScratchFolder scratch;
    const std::string target = scratch.path("t.png");
    for (const bool folder : { false, true }) {
        const auto made = folder ? make_unfinished_folder(target) : make_unfinished_file(target);
        REQUIRE(made);
        CHECK(leftovers(target).empty());
        ::close(made->descriptor);
        CHECK(leftovers(scratch.path("other.png")).empty());
        CHECK(leftovers(target) == std::vector<std::string>{ base_name(made->path) });
        fs::remove(made->path);
    }
    const auto nowhere = make_unfinished_file("/no/such/folder/x");
    REQUIRE_FALSE(nowhere);
    CHECK(nowhere.error().message == "No such file or directory");
}

TEST_CASE("links and pipes under such a name are no leftovers, and are not waited for")
{
    const ScratchFolder scratch;
    const std::string target = scratch.path("t");
    fs::create_symlink(scratch.file("precious"), unfinished_name(target));
    fs::create_directory_symlink(scratch.path(), unfinished_name(target));
    REQUIRE(mkfifo(unfinished_name(target).c_str(), 0600) == 0);
    CHECK(leftovers(target).empty());
}

TEST_CASE("programs that start at once do not take each other's new folders for leftovers")
{
    const ScratchFolder scratch;
    const fs::path target = scratch.path("t");
    std::vector<pid_t> children;
    for (int i = 0; i < 8; ++i)
        if (children.push_back(fork()); children.back() == 0) {
            for (int k = 0; k < 300; ++k) {
                for_each_leftover(target, [](const fs::path& path) { fs::remove_all(path); });
                const auto made = make_unfinished_folder(target);
                if (!made || !fs::exists(made->path))
                    _exit(1);
                std::ofstream(made->path + "/file") << k;
                if (!fs::exists(made->path + "/file"))
                    _exit(2);
                fs::remove_all(made->path);
                ::close(made->descriptor);
            }
            _exit(0);
        }
    for (const pid_t child : children) {
        int status = -1;
        waitpid(child, &status, 0);
        CHECK(status == 0);
    }
    CHECK(fs::is_empty(scratch.path()));
}
