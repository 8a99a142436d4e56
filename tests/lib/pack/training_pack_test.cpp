// SPDX-License-Identifier: Apache-2.0
#include "pack/training_pack.h"

#include <cmath>
#include <cstring>
#include <filesystem>

#include <doctest/doctest.h>

#include "pack/training_pack_writer.h"
#include "scratch_folder.h"
#include "tiny_pack.h"

using namespace srisp;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kImage = 3 * kSmallestPackImage * kSmallestPackImage;

/// A fresh pack for each kind of damage.
class Damaged {
public:
    Damaged() : m_pack(m_scratch.path("p")) { write_tiny_pack(m_pack); }

    /// What opening says, after "pack '…'"; "" if it opens.
    std::string message() const
    {
        if (open_error(m_pack).empty())
            return "";
        const std::string text = open_error(m_pack), begin = "pack '" + m_pack + "'";
        return text.compare(0, begin.size(), begin) == 0 ? text.substr(begin.size()) : "not about the pack: " + text;
    }
    std::string after_index(const std::function<void(json&)>& edit) const
    {
        edit_index(m_pack, edit);
        return message();
    }
    std::string after_part(const std::string& part, const std::function<void(std::string&)>& edit) const
    {
        edit_part(m_pack, part, edit);
        return message();
    }
    std::string path(const std::string& file) const { return m_pack + "/" + file; }

private:
    ScratchFolder m_scratch;
    std::string m_pack;
};

/// Sets element `index` of a float tensor in the bytes of a safetensors file.
void set_float(std::string& bytes, const std::string& tensor, std::size_t index, float value)
{
    std::uint64_t length;
    std::memcpy(&length, bytes.data(), 8);
    const json header = json::parse(bytes.substr(8, length));
    std::memcpy(&bytes[8 + length + header[tensor]["data_offsets"][0].get<std::size_t>() + 4 * index], &value, 4);
}

/// Replaces the header; the data stay.
void set_header(std::string& bytes, const std::string& header)
{
    std::uint64_t length;
    std::memcpy(&length, bytes.data(), 8);
    const std::string data = bytes.substr(8 + length);
    length = header.size();
    bytes = std::string(reinterpret_cast<const char*>(&length), 8) + header + data;
}

} // namespace

TEST_CASE("a training pack is read back as it was written")
{
    const ScratchFolder scratch;
    write_tiny_pack(scratch.path("p"));
    const auto pack = TrainingPack::open(scratch.path("p"));
    REQUIRE_MESSAGE(pack, (pack ? "" : pack.error().message));
    const PackedImages& photos = (*pack)->photos();
    REQUIRE(photos.entries.size() == 3);
    CHECK(photos.size == kSmallestPackImage);
    CHECK(photos.entries[1].name == "a.jpg");
    CHECK(photos.entries[1].scene == 0);
    CHECK(photos.entries[1].crop == std::array<float, 4>{ 0.25f, 0, 0.75f, 0.5f });
    CHECK(photos.entries[2].scene == 1);
    CHECK(photos.entries[2].open);
    CHECK(photos.entries[2].licence == "CC0");
    CHECK(photos.entries[2].white_balance[1] == 0);
    CHECK((*photos.image(2))[5] == std::uint16_t((2 * kImage + 5) * 7));
    const PackEntry& raw = (*pack)->raws().entries.at(0);
    CHECK(raw.validation);
    CHECK(raw.group == "Nikon D1");
    CHECK(raw.white_balance == std::array<float, 3>{ 2, 1, 1.5f });
    CHECK(raw.color[8] == 2);
    const PackedCameras& cameras = (*pack)->cameras();
    CHECK(cameras.names == std::vector<std::string>{ "Anna One", "Berta Two" });
    CHECK(cameras.validation == std::vector<bool>{ false, true });
    CHECK(cameras.light_kinds == std::vector<std::string>{ "daylight", "tungsten" });
    CHECK(cameras.wavelengths.back() == 780);
    CHECK(cameras.reflectance.size() == 3 * kPackWavelengths);
    CHECK((*pack)->hash().compare(0, 6, "xxh64:") == 0);
}

TEST_CASE("a pack that is made shorter while it is open gives errors, not images")
{
    const ScratchFolder scratch;
    write_tiny_pack(scratch.path("p"));
    const auto pack = TrainingPack::open(scratch.path("p"));
    REQUIRE(pack);
    const std::string photos = scratch.path("p/photos.safetensors");
    fs::resize_file(photos, fs::file_size(photos) - 1);
    CHECK((*pack)->photos().image(0));
    const auto cut = (*pack)->photos().image(2);
    REQUIRE_FALSE(cut);
    CHECK(cut.error().message.find("pack '" + scratch.path("p") +
                                   "': photos.safetensors was made shorter while it was read: it had ") == 0);
}

TEST_CASE("a pack may lack parts, but not all of them")
{
    CHECK(Damaged().after_index([](json& index) { index.erase("photos"), index.erase("cameras"); }).empty());
    CHECK(Damaged().after_index([](json& index) {
        index.erase("photos"), index.erase("cameras"), index.erase("raws");
    }) == ": pack.json: the pack is empty (no photos, raws or cameras)");
}

TEST_CASE("what is no training pack is refused by name")
{
    const ScratchFolder scratch;
    CHECK(open_error("/no/such") == "pack '/no/such' does not exist");
    CHECK(open_error(scratch.file("f")) == "pack '" + scratch.path("f") + "' is not a folder");
    CHECK(open_error(scratch.path()) == "pack '" + scratch.path() + "' is not a training pack: it has no pack.json");
}

TEST_CASE("files of a pack that are missing, truncated or damaged are refused")
{
    const Damaged missing, truncated, empty, changed;
    fs::remove(missing.path("raws.safetensors"));
    CHECK(missing.message() ==
          ": '" + missing.path("raws.safetensors") + "' cannot be opened: No such file or directory");
    fs::resize_file(truncated.path("photos.safetensors"), 5000);
    CHECK(truncated.message() == ": photos.safetensors has 5000 bytes, pack.json says 18688 (truncated?)");
    fs::resize_file(empty.path("photos.safetensors"), 0);
    CHECK(empty.message() == ": '" + empty.path("photos.safetensors") + "' is empty");
    std::string bytes = bytes_of(changed.path("raws.safetensors"));
    bytes[4000] ^= 1;
    write_bytes(changed.path("raws.safetensors"), bytes);
    CHECK(changed.message().find(": raws.safetensors is damaged: its hash is xxh64:") == 0);
}

TEST_CASE("an index that is damaged, of another version or contradictory is refused")
{
    const Damaged text, cut;
    write_bytes(text.path("pack.json"), "{\"format\"");
    CHECK(text.message().find(": pack.json is not a JSON object") == 0);
    write_bytes(cut.path("pack.json"), "");
    CHECK(cut.message().find(": pack.json is not a JSON object") == 0);
    const auto after = [](const std::function<void(json&)>& edit) { return Damaged().after_index(edit); };
    CHECK(after([](json& index) { index["format"] = "srisp-pack-2"; }) ==
          ": pack.json: format is 'srisp-pack-2', this program reads 'srisp-pack-1'");
    CHECK(after([](json& index) { index.erase("format"); }) == ": pack.json: has no 'format'");
    CHECK(after([](json& index) { index["photo"] = 1; }) ==
          ": pack.json: has an unknown key 'photo'; did you mean 'photos'?");
    CHECK(after([](json& index) { index["photos"]["images"].erase(1); }) ==
          ": photos.safetensors: tensor 'pixels' has shape [3, 3, 32, 32], pack.json needs [2, 3, 32, 32]");
    CHECK(after([](json& index) { index["photos"]["images"] = json::array(); }) ==
          ": pack.json: 'photos' holds no images");
    CHECK(after([](json& index) { index["photos"]["size"] = 31; }) ==
          ": pack.json: 'photos' 'size' is 31, must be a whole number from 32 to 1024");
    CHECK(after([](json& index) { index["photos"]["size"] = 64; }) ==
          ": photos.safetensors: tensor 'pixels' has shape [3, 3, 32, 32], pack.json needs [3, 3, 64, 64]");
    CHECK(after([](json& index) { index["photos"]["file"] = "../x"; }) ==
          ": pack.json: 'photos' 'file' is '../x', must be the name of a file in the pack");
    CHECK(after([](json& index) { index["raws"]["images"][0]["open"] = "yes"; }) ==
          ": pack.json: 'raws' 'images': image 0 'open' must be true or false");
    CHECK(after([](json& index) { index["raws"]["images"][0]["crops"][0][2] = 1.5; }) ==
          ": pack.json: 'raws' 'images': image 0 'crops' must be lists of left < right, top < bottom (0 … 1), in the "
          "order left, top, right, bottom");
    CHECK(after([](json& index) {
              index["raws"]["images"][0]["white_balance"] = { 1, 0, 1 };
          }) == ": pack.json: 'raws' 'images': image 0 'white_balance' must be above 0");
    CHECK(after([](json& index) {
              index["raws"]["images"][0]["color"] = { 1, 0, 1 };
          }) == ": pack.json: 'raws' 'images': image 0 'color' has 3 numbers, needs 9");
    CHECK(after([](json& index) { index["raws"]["images"][0] = 7; }) ==
          ": pack.json: 'raws' 'images': image 0 is not a JSON object");
    CHECK(after([](json& index) { index["cameras"]["cameras"].erase(0); }) ==
          ": cameras.safetensors: tensor 'sensitivities' has shape [2, 3, 81], pack.json needs [1, 3, 81]");
    CHECK(after([](json& index) { index["cameras"]["lights"][0]["kind"] = "dayligt"; }) ==
          ": pack.json: 'cameras' 'lights': light 0 has kind 'dayligt'; did you mean 'daylight'?");
}

TEST_CASE("tensors of a pack that are of another kind, or hold impossible numbers, are refused")
{
    const auto after = [](const std::string& part, const std::function<void(std::string&)>& edit) {
        return Damaged().after_part(part, edit);
    };
    CHECK(after("raws", [](std::string& bytes) { bytes.resize(7); }) ==
          ": raws.safetensors: not a safetensors file, it has 7 bytes, at least 8 needed");
    CHECK(after("raws", [](std::string& bytes) {
              set_header(bytes, R"({"pixels":{"dtype":"F16","shape":[1,3,32,32],"data_offsets":[0,6144]}})");
          }) == ": raws.safetensors: tensor 'pixels' has type F16, not U16");
    CHECK(after("raws", [](std::string& bytes) {
              set_header(bytes, R"({"pixel":{"dtype":"U16","shape":[1,3,32,32],"data_offsets":[0,6144]}})");
          }) == ": raws.safetensors must hold one tensor, 'pixels'");
    CHECK(after("raws", [](std::string& bytes) {
              set_header(bytes, R"({"pixels": {"dtype":"U16","shape":[1,3,32,32],"data_offsets":[0,6144]}})");
          }) == ": raws.safetensors: tensor 'pixels' begins at byte 79, which is odd");
    CHECK(after("cameras", [](std::string& bytes) { set_float(bytes, "sensitivities", 90, NAN); }) ==
          ": cameras.safetensors: tensor 'sensitivities' has nan at element 90");
    CHECK(after("cameras", [](std::string& bytes) { set_float(bytes, "lights", 1, -1); }) ==
          ": cameras.safetensors: tensor 'lights' has -1.000000 at element 1");
    CHECK(after("cameras", [](std::string& bytes) { set_float(bytes, "reflectance", 3, INFINITY); }) ==
          ": cameras.safetensors: tensor 'reflectance' has inf at element 3");
    CHECK(after("cameras", [](std::string& bytes) { set_float(bytes, "wavelengths", 2, 391); }) ==
          ": cameras.safetensors: wavelengths must be 380, 385, ... 780 nm; element 2 is 391.000000");
}

TEST_CASE("a pack that is not finished leaves nothing, and what is there is replaced only when asked for")
{
    const ScratchFolder scratch;
    const std::string target = scratch.path("p");
    {
        const auto pack = TrainingPackWriter::create(target, false);
        REQUIRE(pack);
        PackImagesWriter photos((*pack)->photos_path(), 64);
        CHECK_FALSE((*pack)->add_photos(photos)); // no images
    }
    CHECK(fs::is_empty(scratch.path()));
    write_tiny_pack(target);
    const auto refused = TrainingPackWriter::create(target, false);
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message == "'" + target + "' exists already; --replace makes it anew");
    write_tiny_pack(target);
    CHECK(open_error(target).empty());
    CHECK(std::distance(fs::directory_iterator(scratch.path()), fs::directory_iterator()) == 1);
}
