// SPDX-License-Identifier: Apache-2.0
#include "base/file_part.h"

#include <doctest/doctest.h>

#include "base/hashes.h"
#include "scratch_folder.h"

using namespace srisp;
namespace fs = std::filesystem;

TEST_CASE("a file that is made shorter while it is read is an error")
{
    const ScratchFolder scratch;
    const std::string path = scratch.file("a", std::string(100000, 'x'));
    auto file = RegularFile::open(path);
    REQUIRE(file);
    char bytes[10];
    CHECK(read_bytes(*file, bytes, 99990, 10));
    fs::resize_file(path, 50000);
    const Status status = read_bytes(*file, bytes, 49995, 10);
    REQUIRE_FALSE(status);
    CHECK(status.error().message == "was made shorter while it was read: it had 100000 bytes, and ends at 50000");
    const auto hash = xxh64_of_file(*file);
    REQUIRE_FALSE(hash);
    CHECK(hash.error().message.find("was made shorter") == 0);
}

TEST_CASE("the hash of a file is that of its bytes, for every length of tail and of parts")
{
    const ScratchFolder scratch;
    for (const std::size_t size : { 1u, 31u, 32u, 33u, 1u << 20, (1u << 20) + 7, (3u << 20) + 32 }) {
        std::string bytes(size, '\0');
        for (std::size_t i = 0; i < size; ++i)
            bytes[i] = char(i * 37 + i / 251);
        const auto file = RegularFile::open(scratch.file("a", bytes));
        REQUIRE(file);
        CHECK(*xxh64_of_file(*file) == xxh64_of_bytes(bytes.data(), bytes.size()));
    }
}
