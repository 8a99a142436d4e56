// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispbatch/manifest.h"

#include <filesystem>

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

std::string line(const std::string& hash, int time)
{
    return R"({"output":"a.exr","bytes":1,"output_hash":")" + hash + R"(","time":)" + std::to_string(time) + "}\n";
}

std::string last_hash(const std::string& folder)
{
    return Manifest(folder, "all").entries().at("a.exr").hash;
}

} // namespace

TEST_CASE("in one file the later line is the last, though the clock went backwards")
{
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.path("manifest"));
    folder.file("manifest/all.jsonl", line("first", 7200) + line("second", 3600));
    CHECK(last_hash(folder.path()) == "second");
    CHECK(merge_manifests(folder.path()) == 1);
    CHECK(last_hash(folder.path()) == "second");
}

TEST_CASE("of two files the one with the later time has the last line, whatever their names")
{
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.path("manifest"));
    folder.file("manifest/0-of-2.jsonl", line("later", 7200));
    folder.file("manifest/1-of-2.jsonl", line("earlier", 3600));
    CHECK(last_hash(folder.path()) == "later");
}
