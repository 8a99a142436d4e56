// SPDX-License-Identifier: Apache-2.0
#include "reference/camera_files.h"

#include <algorithm>
#include <set>
#include <thread>

#include <sys/stat.h>

#include <srisp/reference.h>

#include "lib/reference/synthetic_dng.h"
#include "scratch_folder.h"
#include "shared_files.h"

using namespace srisp;

namespace {

std::string flat_dng(int level)
{
    SyntheticDng dng;
    return dng.fill([&](int, int, int) { return level; }).bytes();
}

std::string chosen(const std::string& pattern, std::uint64_t seed, const std::string& photo)
{
    const auto path = choose_reference(pattern, seed, photo);
    return path ? *path : path.error().message;
}

} // namespace

TEST_CASE("A folder stands for its RAW files, sorted by name; other files and folders inside are left out")
{
    const ScratchFolder folder;
    for (const char* name : { "b.dng", "A.NEF", "c.cr2", "notes.txt", "photo.jpg", "x.dng.bak", "noextension" })
        folder.file(name);
    std::filesystem::create_directory(folder.path("inside.dng"));
    const auto files = expand_reference(folder.path());
    REQUIRE(files);
    CHECK(*files == std::vector<std::string>{ folder.path("A.NEF"), folder.path("b.dng"), folder.path("c.cr2") });
}

TEST_CASE("Globs and lists stand for what they match, each file once")
{
    const ScratchFolder folder;
    for (const char* name : { "b.dng", "a.dng", "c.exr", "odd;name*.dng" })
        folder.file(name);
    const std::string a = folder.path("a.dng"), b = folder.path("b.dng"), odd = folder.path("odd;name*.dng");
    CHECK(*expand_reference(folder.path("[ab].dng")) == std::vector<std::string>{ a, b });
    CHECK(*expand_reference(b + ";" + a + ";;" + b) == std::vector<std::string>{ a, b });
    CHECK(*expand_reference(folder.path("?.dng") + ";" + folder.path("c.exr")) ==
          std::vector<std::string>{ a, b, folder.path("c.exr") });
    CHECK(*expand_reference(odd) == std::vector<std::string>{ odd }); // a file of this very name wins
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

TEST_CASE("Missing, unreadable, empty and irregular files and folders are told")
{
    const ScratchFolder folder;
    const auto message = [](const std::string& path) {
        const auto reference = load_reference(path);
        return reference ? std::string("(it loaded)") : reference.error().message;
    };
    const std::string missing = folder.path("missing.dng"), empty = folder.file("empty.dng", "");
    CHECK(message(missing) == "reference '" + missing + "': No such file or directory");
    CHECK(message(folder.path()) == "reference '" + folder.path() + "': is a folder; a file is expected here");
    CHECK(message(empty) == "reference '" + empty + "': is empty");
    REQUIRE(::mkfifo(folder.path("fifo.dng").c_str(), 0600) == 0);
    CHECK(message(folder.path("fifo.dng")).find("is not a regular file") != std::string::npos);
    CHECK(message(folder.file("garbage.dng", std::string(5000, 'g'))).find("is not a RAW file that LibRaw") !=
          std::string::npos);
    CHECK(message(folder.file("x3f", "FOVb" + std::string(500, '\0'))).find("Foveon") != std::string::npos);
}

TEST_CASE("The cache gives the same object for the same file and another for a changed one")
{
    const ScratchFolder folder;
    const std::string path = folder.file("a.dng", flat_dng(10000));
    const auto first = load_reference_cached(path), again = load_reference_cached(path);
    REQUIRE(first);
    REQUIRE(again);
    CHECK(first->get() == again->get());

    const std::string other = folder.file("b.dng", flat_dng(20000));
    std::filesystem::rename(other, path);
    const auto changed = load_reference_cached(path);
    REQUIRE(changed);
    CHECK((*changed)->thumbnail.rgb[0] > (*first)->thumbnail.rgb[0]);

    std::filesystem::remove(path);
    CHECK(!load_reference_cached(path));
    folder.file("a.dng", "not a RAW file");
    CHECK(!load_reference_cached(path));
}

TEST_CASE("Many threads that want one file get one object, and the cache forgets the oldest of many files")
{
    const ScratchFolder folder;
    const std::string path = folder.file("a.dng", flat_dng(10000));
    std::vector<std::shared_ptr<const Reference>> got(8);
    std::vector<std::thread> threads;
    for (auto& mine : got)
        threads.emplace_back([&] { mine = *load_reference_cached(path); });
    for (auto& thread : threads)
        thread.join();
    CHECK(std::all_of(got.begin(), got.end(), [&](const auto& mine) { return mine && mine == got[0]; }));

    const std::weak_ptr<const Reference> watched = got[0];
    got.clear();
    CHECK(!watched.expired());
    for (int i = 0; i < 64; ++i)
        CHECK(load_reference_cached(folder.file(std::to_string(i) + ".dng", flat_dng(5000 + i))));
    CHECK(watched.expired());
}
