// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispeval/journal.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "../failure_of.h"
#include "scratch_folder.h"
#include "some_scores.h"

using namespace srisp::tool;

namespace {

EvaluatedImage some_image(const std::string& file)
{
    EvaluatedImage image;
    image.score = some_score(file, "X", 30, 35);
    image.pictures.width = 3;
    image.pictures.height = 2;
    image.pictures.photo = "photo of " + file;
    image.pictures.truth = std::string("a\n\0b", 4);
    image.pictures.results = { { "first", "1" }, { "second", "22" } };
    image.pictures.white_balance = { 2, 1, 1.5f };
    image.lab["first"] = { { 1, 2, 3 }, { 4, 5, 6 } };
    return image;
}

} // namespace

TEST_CASE("what a journal holds is there for the next run, pictures and histograms too")
{
    const ScratchFolder folder;
    const std::string path = folder.path("j");
    {
        Journal journal(path, "settings");
        journal.append("one", { some_image("a.dng"), some_image("b.dng") });
        journal.append("two", { some_image("c.dng") }, { { "c.dng", "no JPEG" } });
    }
    Journal journal(path, "settings");
    REQUIRE(journal.left_out().at("two").size() == 1);
    CHECK(journal.left_out().at("two")[0].reason == "no JPEG");
    CHECK(journal.tasks() == std::set<std::string>{ "one", "two" });
    REQUIRE(journal.entries().size() == 3);
    const Journal::Entry& entry = journal.entries()[2];
    CHECK(entry.score.image == "c.dng");
    const ImagePictures pictures = journal.pictures(entry);
    CHECK(pictures.photo == "photo of c.dng");
    CHECK(pictures.truth == std::string("a\n\0b", 4));
    CHECK(pictures.results.at("second") == "22");
    CHECK(pictures.width == 3);
    CHECK(pictures.white_balance[2] == 1.5f);
    CHECK(journal.lab(entry).at("first").wanted == std::vector<std::int64_t>{ 4, 5, 6 });
    journal.append("three", { some_image("d.dng") });
    CHECK(journal.pictures(journal.entries()[3]).photo == "photo of d.dng");
    CHECK(journal.pictures(journal.entries()[0]).photo == "photo of a.dng");
    journal.remove();
    CHECK(!std::filesystem::exists(path));
}

TEST_CASE("wherever a journal was cut off, whole records count, and the next ones follow them")
{
    const ScratchFolder folder;
    const std::string path = folder.path("j");
    std::uintmax_t first_end = 0;
    {
        Journal journal(path, "settings");
        journal.append("one", { some_image("a.dng") });
        first_end = std::filesystem::file_size(path);
        journal.append("two", { some_image("b.dng") });
    }
    const std::uintmax_t whole = std::filesystem::file_size(path);
    const std::string copy = folder.path("copy");
    for (std::uintmax_t size = 0; size <= whole; size += 7) {
        std::filesystem::copy_file(path, copy, std::filesystem::copy_options::overwrite_existing);
        std::filesystem::resize_file(copy, size);
        Journal journal(copy, "settings");
        CHECK(journal.tasks().count("one") == (size >= first_end));
        CHECK(journal.tasks().count("two") == (size >= whole));
        journal.append("more", { some_image("m.dng") });
        CHECK(journal.pictures(journal.entries().back()).photo == "photo of m.dng");
    }
}

TEST_CASE("a record whose pictures are not described as they must be is damaged, and ends what counts")
{
    const ScratchFolder folder;
    const std::string path = folder.path("j");
    {
        Journal journal(path, "settings");
        journal.append("one", { some_image("a.dng") });
    }
    std::ifstream file(path, std::ios::binary);
    const std::string whole{ std::istreambuf_iterator<char>(file), {} };
    for (const auto& [from, to] : { std::pair<std::string, std::string>{ R"("size":[3,2,0,0])", R"("size":[3,2])" },
                                    { R"("size":[3,)", R"("size":[1e300,)" },
                                    { R"("size":[3,)", R"("size":["3",)" },
                                    { R"("size":)", R"("sizes":)" },
                                    { R"("white_balance":)", R"("other":)" },
                                    { R"("color":)", R"("colour":)" },
                                    { R"(["photo",14])", R"(["photo",1e300])" },
                                    { R"(["photo",14])", R"(["photo",-14])" },
                                    { R"(["photo",14])", R"([14,14])" } }) {
        const std::string& shown = to;
        INFO(shown);
        std::string damaged = whole;
        const std::size_t at = damaged.find(from);
        REQUIRE(at != std::string::npos);
        std::ofstream(path, std::ios::binary) << damaged.replace(at, from.size(), to);
        CHECK(Journal(path, "settings").tasks().empty());
    }
    std::ofstream(path, std::ios::binary) << whole;
    CHECK(Journal(path, "settings").tasks().size() == 1);
}

TEST_CASE("a journal of other settings, or of anything else, begins anew; two runs do not share one")
{
    const ScratchFolder folder;
    const std::string path = folder.path("j");
    {
        Journal journal(path, "settings");
        journal.append("one", { some_image("a.dng") });
        CHECK(failure_of([&] { Journal second(path, "settings"); }).find("in use by another") != std::string::npos);
    }
    CHECK(Journal(path, "others").tasks().empty());
    std::ofstream(path) << "something else\n";
    CHECK(Journal(path, "settings").tasks().empty());
    CHECK(failure_of([&] { Journal journal(folder.path("none/j"), ""); }).find("cannot be created") !=
          std::string::npos);
}
