// SPDX-License-Identifier: Apache-2.0
#include "model/safetensors.h"

#include <cmath>
#include <cstring>
#include <filesystem>

#include <Imath/half.h>
#include <doctest/doctest.h>

#include "base/half_float.h"
#include "base/input_file.h"
#include "base/output_file.h"
#include "random_model.h"

using namespace srisp;

namespace {

std::string file_of(const std::string& header, const std::string& data)
{
    const std::uint64_t length = header.size();
    return std::string(reinterpret_cast<const char*>(&length), 8) + header + data;
}

std::string message(const std::string& bytes)
{
    Expected<SafeTensors> file = parse_safetensors(bytes, "model 'm'");
    return file ? "no error" : file.error().message;
}

const char kTwoFloats[] = "\0\0\x80\x3f\0\0\0\xc0"; // 1, −2

} // namespace

TEST_CASE("float32, float16 and bfloat16 tensors come out as float32")
{
    const std::string header = R"({"__metadata__":{"a":"b"},"x":{"dtype":"F32","shape":[2],"data_offsets":[0,8]},)"
                               R"("y":{"dtype":"F16","shape":[1,1],"data_offsets":[8,10]},)"
                               R"("z":{"dtype":"BF16","shape":[1],"data_offsets":[10,12]}})";
    const std::string data = std::string(kTwoFloats, 8) + std::string("\x00\x3e", 2) + std::string("\x40\xc0", 2);
    Expected<SafeTensors> file = parse_safetensors(file_of(header, data), "model 'm'");
    REQUIRE_MESSAGE(file, (file ? "" : file.error().message));
    CHECK(file->metadata.at("a") == "b");
    CHECK(file->tensors.at("x").values == std::vector<float>{ 1, -2 });
    CHECK(file->tensors.at("y").values == std::vector<float>{ 1.5f });
    CHECK(file->tensors.at("y").shape == std::vector<std::int64_t>{ 1, 1 });
    CHECK(file->tensors.at("z").values == std::vector<float>{ -3 });
}

TEST_CASE("every half is converted as Imath converts it")
{
    for (int bits = 0; bits < 65536; ++bits) {
        Imath::half imath;
        imath.setBits(static_cast<unsigned short>(bits));
        const float expected = imath, actual = float_from_half(static_cast<std::uint16_t>(bits));
        if (std::isnan(expected) ? !std::isnan(actual) : actual != expected)
            FAIL_CHECK("half ", bits, " gives ", actual, ", not ", expected);
    }
}

TEST_CASE("floats are rounded to halves as Imath rounds them")
{
    for (std::uint64_t i = 0; i < (1u << 20); ++i) {
        // All exponents and signs, and of the mantissa the bits that matter to the rounding.
        const std::uint32_t bits = static_cast<std::uint32_t>(i << 12) | (i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : 0x800);
        float value;
        std::memcpy(&value, &bits, 4);
        const std::uint16_t expected = Imath::half(value).bits(), actual = half_from_float(value);
        if (std::isnan(value) ? !std::isnan(float_from_half(actual)) : actual != expected)
            FAIL_CHECK("float ", value, " gives ", actual, ", not ", expected);
    }
}

TEST_CASE("broken safetensors files are refused, each with its own message")
{
    const std::string data(kTwoFloats, 8);
    const auto x = [&](const std::string& entry) { return message(file_of(R"({"x":)" + entry + "}", data)); };
    CHECK(message("") == "model 'm': not a safetensors file, it has 0 bytes, at least 8 needed");
    CHECK(
        message(std::string("\xff\xff\xff\xff\xff\xff\xff\xff", 8) + "{}") ==
        "model 'm': header of 18446744073709551615 bytes, file has 2 after the length (truncated, or not a safetensors "
        "file)");
    CHECK(message(file_of("{\"x\":", data)) == "model 'm': header is not a JSON object (line 1, column 6)");
    CHECK(message(file_of("[1]", data)) == "model 'm': header is not a JSON object");
    CHECK(message(file_of(R"({"__metadata__":"no"})", "")) == "model 'm': __metadata__ is not an object");
    CHECK(message(file_of(R"({"__metadata__":{"a":1}})", "")) == "model 'm': metadata 'a' is not a string");
    CHECK(x("5") == "model 'm': tensor 'x' needs dtype, shape and data_offsets");
    CHECK(x(R"({"dtype":"I64","shape":[1],"data_offsets":[0,8]})") ==
          "model 'm': tensor 'x' has type I64, not F32, F16 or BF16");
    CHECK(x(R"({"dtype":"F32","shape":[-2],"data_offsets":[0,8]})") ==
          "model 'm': tensor 'x': dtype, shape or data_offsets have the wrong type");
    CHECK(x(R"({"dtype":"F32","shape":[3],"data_offsets":[0,12]})") ==
          "model 'm': tensor 'x' ends at byte 12, file has 8");
    CHECK(x(R"({"dtype":"F32","shape":[2],"data_offsets":[8,0]})") ==
          "model 'm': tensor 'x' begins at byte 8 after its end 0");
    CHECK(x(R"({"dtype":"F32","shape":[3],"data_offsets":[0,8]})") ==
          "model 'm': tensor 'x' of shape [3] needs 12 bytes, has 8");
    CHECK(x(R"({"dtype":"F32","shape":[4294967296,4294967296],"data_offsets":[0,8]})") ==
          "model 'm': tensor 'x' has impossible shape [4294967296, 4294967296]");
    CHECK(x(R"({"dtype":"F32","shape":[1],"data_offsets":[4,8]})") ==
          "model 'm': tensor 'x' begins at byte 4, leaves a gap after the one before, which ends at 0");
    CHECK(x(R"({"dtype":"F32","shape":[1],"data_offsets":[0,4]})") == "model 'm': tensors end at byte 4, file has 8");
    CHECK(message(file_of(R"({"x":{"dtype":"F32","shape":[2],"data_offsets":[0,8]},)"
                          R"("y":{"dtype":"F32","shape":[1],"data_offsets":[4,8]}})",
                          data)) == "model 'm': tensor 'y' begins at byte 4, overlaps the one before, which ends at 8");
    CHECK(message(file_of(R"({"x":{"dtype":"F32","shape":[2],"data_offsets":[0,8]},)"
                          R"("x":{"dtype":"F32","shape":[2],"data_offsets":[0,8]}})",
                          data)) == "model 'm': 'x' appears twice in the header");
}

TEST_CASE("a missing file, a folder and a file that is too large are refused by name")
{
    const auto failure = [](const std::string& path, std::uint64_t limit) {
        Expected<std::string> bytes = read_file(path, limit, "model '" + path + "'");
        return bytes ? "no error" : bytes.error().message;
    };
    CHECK(failure("/no/such.safetensors", 10) ==
          "model '/no/such.safetensors': cannot open '/no/such.safetensors': No such file or directory");
    CHECK(failure("/tmp", 10) == "model '/tmp': '/tmp' is a folder, not a file");
    CHECK(failure("/etc/passwd", 3).find("bytes, limit 3") != std::string::npos);
}

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

TEST_CASE("a header of very many or very deep entries is refused at once, in a short message")
{
    std::string equal = "{", different = "{";
    for (int i = 0; i < 200000; ++i) {
        equal += std::string(i ? "," : "") + "\"\":{}";
        different += (i ? ",\"" : "\"") + std::to_string(i) + "\":{}";
    }
    CHECK(message(file_of(equal + "}", "")) == "model 'm': '' appears twice in the header");
    CHECK(message(file_of(different + "}", "")) == "model 'm': has 200000 tensors, limit 65536");
    CHECK(message(file_of("{\"x\":" + std::string(100000, '['), "")) ==
          "model 'm': header is nested more than 32 levels deep");
    CHECK(message(file_of("{\"" + std::string(1000000, 'n') + "\":{}}", "")).size() < 300);
    CHECK(message(file_of(std::string((std::size_t(16) << 20) + 1, ' '), "")) ==
          "model 'm': header of 16777217 bytes, limit 16777216");
}
