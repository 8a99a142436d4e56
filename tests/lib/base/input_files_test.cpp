// SPDX-License-Identifier: Apache-2.0
#include "base/input_files.h"

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;
namespace fs = std::filesystem;

TEST_CASE("an output is an input under every name of its file, and no other file is")
{
    const ScratchFolder scratch;
    const std::string input = scratch.file("ref.dng");
    fs::create_hard_link(input, scratch.path("hard"));
    fs::create_symlink(input, scratch.path("soft"));
    fs::create_directory_symlink(scratch.path(), scratch.path("folder"));
    InputFiles inputs;
    inputs.add("reference", input);
    inputs.add("photo", scratch.path("none"));
    inputs.add("photo", "/dev/null");
    inputs.add("photo", scratch.path());
    for (const char* name : { "ref.dng", "hard", "soft", "./ref.dng", "folder/ref.dng", "folder/folder/hard" }) {
        const Status status = inputs.check_output(scratch.path(name));
        REQUIRE_FALSE(status);
        CHECK(status.error().message == "output '" + scratch.path(name) + "' is the reference '" + input +
                                            "' itself; inputs are never overwritten");
    }
    for (const std::string& name : { scratch.file("same content"), scratch.path("none"), scratch.path(),
                                     std::string("/dev/null"), std::string() })
        CHECK(inputs.check_output(name));
}
