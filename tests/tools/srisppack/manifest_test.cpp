// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisppack/manifest.h"

#include <filesystem>

#include <sys/stat.h>

#include <doctest/doctest.h>

#include "../../../tools/common/csv_table.h"
#include "../failure_of.h"
#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::tool;

TEST_CASE("a table is read with quotes, empty fields, Windows line ends and a missing last line end")
{
    const ScratchFolder scratch;
    const CsvTable table = read_csv(scratch.file("t.csv", "\xef\xbb\xbf"
                                                          "a,b\r\n\"x, \"\"y\"\"\",\r\n\r\n1,\"two\nlines\""));
    CHECK(table.columns == std::vector<std::string>{ "a", "b" });
    REQUIRE(table.rows.size() == 2);
    CHECK(table.rows[0] == std::vector<std::string>{ "x, \"y\"", "" });
    CHECK(table.rows[1] == std::vector<std::string>{ "1", "two\nlines" });
}

TEST_CASE("broken tables are refused with file and line")
{
    const ScratchFolder scratch;
    const auto message = [&](const std::string& text) {
        const std::string path = scratch.file("t.csv", text);
        const std::string full = failure_of([&] { read_csv(path); });
        return full.substr(full.find("t.csv'") + 6);
    };
    CHECK(message("") == " is empty");
    CHECK(message("a,b\n1\n") == ", line 2: has 1 fields, the header has 2");
    CHECK(message("a,b\n\"1,2\n") == ", line 2: a quote is not closed");
    CHECK(message("a,b\n\"1\"x,2\n") == ", line 2: text behind a closing quote");
    CHECK(message("a,a\n") == ": column 'a' appears twice");
}

TEST_CASE("a manifest says what is known of files")
{
    const ScratchFolder scratch;
    scratch.file("manifest.csv", "licence,file,open,use,width\nCC0,a.jpg,yes,validation,9\n,sub/b.jpg,no,training,9\n");
    const Manifest manifest = Manifest::of_folder(scratch.path());
    CHECK(manifest.present());
    const Provenance a = manifest.of("a.jpg"), b = manifest.of("sub/b.jpg");
    CHECK((a.listed && a.open && a.validation && a.licence == "CC0" && a.source == "not stated"));
    CHECK((b.listed && !b.open && !b.validation && b.licence == "not stated"));
}

TEST_CASE("a manifest that contradicts itself is refused")
{
    const ScratchFolder scratch;
    const auto message = [&](const std::string& text) {
        scratch.file("manifest.csv", text);
        const std::string full = failure_of([&] { Manifest::of_folder(scratch.path()); });
        return full.substr(full.find("manifest.csv'") + 13);
    };
    CHECK(message("fiel,use\n") == " has no column 'file'; did you mean 'fiel'?");
    CHECK(message("file,use\na,train\n") == ", file 'a': 'train' is neither validation nor training");
    CHECK(message("file,open\na,maybe\n") == ", file 'a': 'maybe' is neither yes nor no");
    CHECK(message("file\na\na\n") == ", file 'a' is listed twice");
}

TEST_CASE("without a manifest about every tenth file is for validation, the same on every machine")
{
    const Manifest none = Manifest::of_folder("/no/such");
    CHECK_FALSE(none.present());
    int validation = 0;
    for (int i = 0; i < 10000; ++i)
        validation += none.of(std::to_string(i)).validation;
    CHECK(validation == 982); // what counts is that it never changes
    CHECK_FALSE(none.of("IMG_1.jpg").open);
    CHECK(none.of("IMG_1.jpg").validation == none.of("folder/IMG_1.jpg").validation);
}

TEST_CASE("a table that a stranger has filled with columns, or that is no file, is refused at once")
{
    const ScratchFolder scratch;
    std::string many = "x";
    for (int i = 0; i < 300000; ++i)
        many += "," + std::to_string(i);
    const std::string table = scratch.file("manifest.csv", many + "\n");
    CHECK(failure_of([&] { read_csv(table); }) == "1: '" + table + "': has 300001 columns, limit 10000");
    scratch.file("manifest.csv", std::string(10000000, 'f') + "\n");
    CHECK(failure_of([&] { Manifest::of_folder(scratch.path()); }).size() < 1000);
    std::filesystem::remove(table);
    REQUIRE(::mkfifo(table.c_str(), 0600) == 0);
    CHECK(failure_of([&] { Manifest::of_folder(scratch.path()); }) == "1: '" + table + "': is not a regular file");
}
