// SPDX-License-Identifier: Apache-2.0
#include <srisp/reference.h>

#include <algorithm>
#include <thread>

#include <sys/stat.h>

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

} // namespace

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
