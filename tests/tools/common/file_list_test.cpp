// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/common/file_list.h"

#include <doctest/doctest.h>

#include <filesystem>

#include "../failure_of.h"
#include "scratch_folder.h"

using namespace srisp::tool;

namespace {

std::string names(const std::vector<ListedFile>& photos)
{
    std::string text;
    for (const ListedFile& photo : photos)
        text += photo.name + " ";
    return text;
}

/// Two photos in folders of their own, and what is none.
std::string set_in(const ScratchFolder& folder)
{
    std::filesystem::create_directories(folder.path("set/street/far"));
    folder.file("set/b.jpg", "");
    folder.file("set/street/far/a.PNG", "");
    folder.file("set/street/notes.txt", "");
    folder.file("set/.b.jpg", "");
    return folder.path("set");
}

} // namespace

TEST_CASE("a folder's photos are found in all folders in it, and named by where they are")
{
    const ScratchFolder folder;
    const std::string set = set_in(folder);
    CHECK(names(list_files({ set }, photo_files(), "")) == "b.jpg street/far/a.PNG ");
    CHECK(names(list_files({ set + "/" }, photo_files(), "*.txt")) == "street/notes.txt ");
    CHECK(names(list_files({ set + "/street/far/a.PNG", set + "/*.jpg" }, photo_files(), "")) == "a.PNG b.jpg ");
}

TEST_CASE("a list names photos, and may name one that is missing")
{
    const ScratchFolder folder;
    const std::string set = set_in(folder);
    const std::string list = folder.file("list.txt", set + "/b.jpg\r\n\n" + folder.path("none.jpg") + "\n");
    CHECK(names(list_files({ "@" + list }, photo_files(), "")) == "b.jpg none.jpg ");
    CHECK(failure_of([&] {
              list_files({ "@" + folder.file("empty.txt", "\n") }, photo_files(), "");
          }).find("names no images") != std::string::npos);
    CHECK(failure_of([&] {
              list_files({ "@" + folder.path("gone.txt") }, photo_files(), "");
          }).find("cannot be read") != std::string::npos);
}

TEST_CASE("what is not there, folders without photos and photos of one name are said")
{
    const ScratchFolder folder;
    const std::string set = set_in(folder);
    CHECK(failure_of([&] { list_files({ folder.path("gone.jpg") }, photo_files(), ""); }).find("does not exist") !=
          std::string::npos);
    CHECK(failure_of([&] {
              list_files({ set + "/street" }, photo_files(), "*.exr");
          }).find("holds no file that fits '*.exr'") != std::string::npos);
    folder.file("b.jpg", "");
    CHECK(failure_of([&] {
              list_files({ set + "/b.jpg", folder.path("b.jpg") }, photo_files(), "");
          }).find("would both be called 'b.jpg'") != std::string::npos);
}
