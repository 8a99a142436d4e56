// SPDX-License-Identifier: Apache-2.0
#include "base/input_file.h"

#include <fstream>

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;

TEST_CASE("a text file is read up to its limit, also one that does not say how long it is")
{
    const ScratchFolder folder;
    const std::string path = folder.path("a.txt");
    for (const std::size_t size : { 1, 99, 100, 4096, 4097, 100000 }) {
        CAPTURE(size);
        const std::string text(size, 'x');
        std::ofstream(path, std::ios::binary) << text;
        for (const std::size_t most : { size, 2 * size + 5000 }) {
            const auto read = read_text_file(path, most);
            REQUIRE(read);
            CHECK(*read == text);
        }
        CHECK(read_text_file(path, size - 1).error().message ==
              "'" + path + "': has more than " + std::to_string(size - 1) + " bytes");
    }
    const auto maps = read_text_file("/proc/self/maps", 1 << 24);
    REQUIRE(maps);
    CHECK(maps->size() > 4096);
    CHECK(maps->back() == '\n');
    CHECK(!read_text_file("/proc/self/maps", 5000));
}
