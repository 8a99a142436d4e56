// SPDX-License-Identifier: Apache-2.0
#include "model/safetensors_writer.h"

#include <cstring>
#include <filesystem>

#include <doctest/doctest.h>

#include "base/output_file.h"
#include "model/safetensors.h"
#include "random_model.h"

using namespace srisp;

namespace {

const float kFloats[] = { 1, -2, 3.5f };
const std::uint16_t kHalves[] = { 0x3e00, 0x3c00, 0xc000 };

std::string contents(const std::string& path)
{
    Expected<std::string> bytes = read_file(path, 1 << 20, "test");
    REQUIRE_MESSAGE(bytes, (bytes ? "" : bytes.error().message));
    return *bytes;
}

std::string failure(const Status& status)
{
    return status ? "no error" : status.error().message;
}

} // namespace

TEST_CASE("what is written as safetensors is what the parser reads")
{
    ScratchFolder folder;
    const std::string path = folder.path("t.safetensors");
    const Status status = write_safetensors(
        path, { { "half", "F16", { 3, 1 }, kHalves }, { "float", "F32", { 3 }, kFloats } }, { { "note", "a\"b\n" } });
    REQUIRE_MESSAGE(status, failure(status));
    Expected<SafeTensors> file = parse_safetensors(contents(path), "test");
    REQUIRE_MESSAGE(file, (file ? "" : file.error().message));
    CHECK(file->metadata.at("note") == "a\"b\n");
    CHECK(file->tensors.at("float").values == std::vector<float>{ 1, -2, 3.5f });
    CHECK(file->tensors.at("half").values == std::vector<float>{ 1.5f, 1, -2 });
    CHECK(file->tensors.at("half").shape == std::vector<std::int64_t>{ 3, 1 });
}

TEST_CASE("safetensors data begin on a multiple of 8 and wide elements come first")
{
    ScratchFolder folder;
    for (int padding = 0; padding < 9; ++padding) {
        const std::string path = folder.path("t.safetensors");
        REQUIRE(write_safetensors(path, { { "half", "F16", { 3 }, kHalves }, { "float", "F32", { 1 }, kFloats } },
                                  { { "note", std::string(padding, 'x') } }));
        const std::string bytes = contents(path);
        std::uint64_t header = 0;
        std::memcpy(&header, bytes.data(), 8);
        CHECK(header % 8 == 0);
        CHECK(std::memcmp(bytes.data() + 8 + header, kFloats, 4) == 0);
        CHECK(bytes.size() == 8 + header + 4 + 6);
    }
}

TEST_CASE("a tensor of unknown type, or a name twice, is refused and nothing is left behind")
{
    ScratchFolder folder;
    const std::string path = folder.path("t.safetensors");
    CHECK(failure(write_safetensors(path, { { "x", "F31", { 3 }, kFloats } }, {})) ==
          "'" + path + "': tensor 'x' has unknown type 'F31'");
    CHECK(failure(write_safetensors(path, { { "x", "F32", { 3 }, kFloats }, { "x", "F32", { 1 }, kFloats } }, {})) ==
          "'" + path + "': two tensors are named 'x'");
    CHECK(std::filesystem::is_empty(folder.path("")));
}

TEST_CASE("an output file appears when it is finished, and not before")
{
    ScratchFolder folder;
    const std::string path = folder.path("out");
    {
        OutputFile file(path);
        file.write("first");
        CHECK(!std::filesystem::exists(path));
        REQUIRE(file.finish());
        CHECK(contents(path) == "first");
    }
    {
        OutputFile abandoned(path);
        abandoned.write("second");
    }
    CHECK(contents(path) == "first");
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path("")), {}) == 1);
}

TEST_CASE("an output file that cannot be written says which and why")
{
    ScratchFolder folder;
    const std::string path = folder.path("missing/out");
    CHECK(failure(write_output_file(path, "text")) == "'" + path + "' cannot be created: No such file or directory");
    std::filesystem::create_directory(folder.path("folder"));
    CHECK(failure(write_output_file(folder.path("folder"), "text")) ==
          "'" + folder.path("folder") + "' cannot be renamed from its temporary name: Is a directory");
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path("")), {}) == 1);
}
