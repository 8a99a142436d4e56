// SPDX-License-Identifier: Apache-2.0
#include "recipe/reference_pattern.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <doctest/doctest.h>
#include <srisp/reference.h>

#include "scratch_folder.h"

using namespace srisp;

namespace {

using Paths = std::vector<std::string>;

std::string chosen(const std::string& pattern, std::uint64_t seed, const std::string& photo)
{
    const auto path = choose_reference(pattern, seed, photo);
    return path ? *path : path.error().message;
}

/// What a text stands for: its items, expanded.
Paths files_of(const std::string& list, const std::string& folder = "")
{
    const auto items = split_references(list, folder);
    REQUIRE_MESSAGE(items, items.error().message);
    Paths resolved;
    for (const std::string& item : *items)
        resolved.push_back(resolved_reference(item, folder));
    const auto files = expand_references(resolved);
    REQUIRE_MESSAGE(files, files.error().message);
    return *files;
}

} // namespace

TEST_CASE("A folder stands for its RAW files, sorted by name; other files and folders inside are left out")
{
    const ScratchFolder folder;
    for (const char* name : { "b.dng", "A.NEF", "c.cr2", "notes.txt", "photo.jpg", "x.dng.bak", "noextension" })
        folder.file(name);
    std::filesystem::create_directory(folder.path("inside.dng"));
    CHECK(files_of(folder.path()) == Paths{ folder.path("A.NEF"), folder.path("b.dng"), folder.path("c.cr2") });
}

TEST_CASE("Globs and lists stand for what they match, each file once")
{
    const ScratchFolder folder;
    for (const char* name : { "b.dng", "a.dng", "c.exr", "odd;name*.dng" })
        folder.file(name);
    const std::string a = folder.path("a.dng"), b = folder.path("b.dng"), odd = folder.path("odd;name*.dng");
    CHECK(files_of(folder.path("[ab].dng")) == Paths{ a, b });
    CHECK(files_of(b + ";" + a + ";;" + b) == Paths{ a, b });
    CHECK(files_of(folder.path("?.dng") + ";" + folder.path("c.exr")) == Paths{ a, b, folder.path("c.exr") });
    CHECK(files_of(odd) == Paths{ odd }); // a file of this very name wins
}

TEST_CASE("a name that exists is itself, alone and beside others, whatever characters it has")
{
    const ScratchFolder folder;
    Paths all;
    for (const char* name : { "a;b.dng", "b.dng", "q?.dng", "x*.dng", "y[1].dng", ";.dng", "end;" })
        all.push_back(folder.file(name));
    std::sort(all.begin(), all.end());
    std::string list;
    for (const std::string& path : all) {
        CHECK(files_of(path) == Paths{ path });
        CHECK(*choose_reference(path, 0, "p.jpg") == path);
        CHECK(*choose_reference(Paths{ path }, 0, "p.jpg") == path);
        list += (list.empty() ? "" : ";") + path;
    }
    folder.file("xx.dng"); // what a glob would find
    folder.file("y1.dng");
    CHECK(files_of(list) == all);
    CHECK(files_of("b.dng;a;b.dng;;x*.dng;", folder.path()) ==
          Paths{ folder.path("a;b.dng"), folder.path("b.dng"), folder.path("x*.dng") });
    CHECK(files_of("?.dng", folder.path()) == Paths{ folder.path(";.dng"), folder.path("b.dng") });
}

TEST_CASE("a folder's own characters are none of a pattern in it")
{
    const ScratchFolder scratch;
    const std::string folder = scratch.path("[odd] *;\\");
    std::filesystem::create_directories(folder);
    const ScratchFolder other;
    std::filesystem::copy_file(other.file("a.dng"), folder + "/a.dng");
    std::filesystem::copy_file(other.file("b.dng"), folder + "/b.dng");
    CHECK(files_of("*.dng", folder) == Paths{ folder + "/a.dng", folder + "/b.dng" });
    CHECK(files_of("b.dng;a.dng", folder) == Paths{ folder + "/a.dng", folder + "/b.dng" });
    CHECK(files_of("/nowhere/c.dng", folder) == Paths{ "/nowhere/c.dng" });
}

TEST_CASE("in a list of paths a ';' parts nothing")
{
    const ScratchFolder folder;
    folder.file("a.dng");
    const std::string both = folder.path("a.dng") + ";" + folder.path("a.dng");
    CHECK(*choose_reference(Paths{ both }, 0, "p.jpg") == both);
    CHECK(chosen(both, 0, "p.jpg") == folder.path("a.dng"));
    CHECK(choose_reference(Paths{}, 0, "p.jpg").error().message == "reference '': no file, folder or pattern given");
}

TEST_CASE("An empty folder, a glob without matches and an empty name are told")
{
    const ScratchFolder folder;
    CHECK(chosen(folder.path(), 0, "p.jpg") == "reference '" + folder.path() + "': this folder holds no RAW files");
    CHECK(chosen(folder.path("*.dng"), 0, "p.jpg") == "reference '" + folder.path("*.dng") + "': no file matches");
    CHECK(chosen("", 0, "p.jpg") == "reference '': no file, folder or pattern given");
    CHECK(chosen(";", 0, "p.jpg") == "reference ';': no file in this list");
    CHECK(chosen(folder.path("missing.dng"), 0, "p.jpg") == folder.path("missing.dng")); // told when it is loaded
}

TEST_CASE("The choice depends on seed and the photo's base name alone, and reaches every file")
{
    const ScratchFolder folder;
    for (int i = 0; i < 10; ++i)
        folder.file("f" + std::to_string(i) + ".dng");
    // Computed in Python. Held for ever: a choice that moves would change what people made.
    CHECK(std::filesystem::path(chosen(folder.path(), 0, "photo.jpg")).filename() == "f7.dng");
    CHECK(std::filesystem::path(chosen(folder.path(), 1, "photo.jpg")).filename() == "f0.dng");
    CHECK(chosen(folder.path(), 5, "/some/where/photo.jpg") == chosen(folder.path(), 5, "photo.jpg"));

    std::set<std::string> by_seed, by_name;
    for (int i = 0; i < 200; ++i) {
        by_seed.insert(chosen(folder.path(), std::uint64_t(i), "photo.jpg"));
        by_name.insert(chosen(folder.path(), 0, "photo" + std::to_string(i) + ".jpg"));
    }
    CHECK(by_seed.size() == 10);
    CHECK(by_name.size() == 10);
}

TEST_CASE("a list of references that is all ';', or longer than any, is told at once, and a URL is never one")
{
    const ScratchFolder folder;
    folder.file("a;b.dng");
    std::string list;
    for (int i = 0; i < 20000; ++i)
        list += "a.dng;";
    CHECK(split_references(list)->size() == 20000);
    CHECK(split_references(list + "a;b.dng", folder.path())->back() == "a;b.dng");
    const auto all = split_references(std::string(200000, ';'));
    CHECK(all.error().message.find("no file in this list") != std::string::npos);
    const auto endless = split_references(std::string(1000000, ';'));
    CHECK(endless.error().message.find("this list has 1000000 bytes, limit 262144") != std::string::npos);
    CHECK(chosen("http://127.0.0.1:9/a.dng", 0, "p.jpg") ==
          "reference 'http://127.0.0.1:9/a.dng': is a URL; only files are read");
}
