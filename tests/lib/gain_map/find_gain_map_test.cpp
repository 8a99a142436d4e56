// SPDX-License-Identifier: Apache-2.0
#include "gain_map/find_gain_map.h"

#include <doctest/doctest.h>

#include "jpeg/jpeg_segments.h"
#include "scratch_folder.h"
#include "ultra_hdr_jpeg.h"

using namespace srisp;

namespace {

const std::string kMissing =
    "its gain map is missing or cut off: the photo says that it has one, and no image in the file is it";

/// "none", "ultra_hdr", "iso", "apple", or the error.
std::string found_in(const std::string& bytes)
{
    // An allocation of the exact size, so that a sanitizer sees every read beyond it.
    const std::vector<char> exact(bytes.begin(), bytes.end());
    const auto found = find_gain_map({ exact.data(), exact.size() });
    if (!found)
        return found.error().message;
    if (!*found)
        return "none";
    const auto kind = (*found)->kind;
    return kind == GainMapInfo::Kind::apple ? "apple" : kind == GainMapInfo::Kind::iso ? "iso" : "ultra_hdr";
}

std::string plain_jpeg()
{
    return jpeg_of(16, 8, 3, [](int x, int y, int c) { return x * 9 + y * 5 + c; });
}

/// A photo whose index alone tells of a second image, which has this XMP.
std::string with_second_image(const std::string& attributes)
{
    UltraHdrJpeg made;
    made.map_attributes = attributes;
    made.has_container = false;
    return made.bytes();
}

} // namespace

TEST_CASE("the map is found by the multi-picture index, and by the container's lengths")
{
    for (const bool has_container : { true, false })
        for (const bool has_index : { true, false })
            for (const bool big_endian : { true, false }) {
                UltraHdrJpeg made;
                made.has_container = has_container;
                made.has_index = has_index;
                made.big_endian = big_endian;
                made.trailer = "what some phones write behind the map";
                const auto found = find_gain_map(made.bytes());
                REQUIRE_MESSAGE(found, (found ? "" : found.error().message));
                CHECK(found->has_value() == (has_container || has_index));
                if (*found) {
                    CHECK((*found)->kind == GainMapInfo::Kind::ultra_hdr);
                    CHECK((*found)->jpeg == made.map());
                    CHECK((*found)->metadata.max[2] == 2);
                }
            }
}

TEST_CASE("a wrong index is made up for by the container")
{
    UltraHdrJpeg made;
    const std::string right = made.bytes();
    // An editor that lengthens a segment before the index's images, and does not know of the index.
    const std::string moved = with_app_segment(right, 14, std::string(100, 'x'));
    const auto found = find_gain_map(moved);
    REQUIRE(found);
    REQUIRE(*found);
    CHECK((*found)->jpeg == made.map());
}

TEST_CASE("without an index, the map is behind what the container lists before it, or else just behind the photo")
{
    const std::string map = UltraHdrJpeg().map(), depth = plain_jpeg();
    const auto found_behind = [&](const std::string& attributes, const std::string& elements, const std::string& more) {
        const auto found = find_gain_map(with_app_segment(plain_jpeg(), 1, xmp_segment(attributes, elements)) + more);
        REQUIRE_MESSAGE(found, (found ? "" : found.error().message));
        REQUIRE(*found);
        return (*found)->jpeg;
    };
    const auto item = [](const std::string& semantic, std::size_t length, int padding) {
        return "<rdf:li><Container:Item><Item:Semantic>" + semantic + "</Item:Semantic><Item:Length>" +
               std::to_string(length) + "</Item:Length><Item:Padding>" + std::to_string(padding) +
               "</Item:Padding></Container:Item></rdf:li>";
    };
    const std::string directory = "<Container:Directory><rdf:Seq>" + item("Primary", 0, 3) +
                                  item("Depth", depth.size(), 0) + item("GainMap", map.size(), 0) +
                                  "</rdf:Seq></Container:Directory>";
    CHECK(found_behind("", directory, "pad" + depth + map + "more") == map);
    CHECK(found_behind(R"(hdrgm:Version="1.0")", "", map) == map);
}

TEST_CASE("ISO 21496-1 goes before XMP, unless it cannot be read")
{
    UltraHdrJpeg made;
    made.map_iso = iso_segment(0x48, { 1, 0, 3, 0, 3, 1, 0, 0 });
    CHECK(found_in(made.bytes()) == "iso");
    made.map_has_xmp = false;
    CHECK(found_in(made.bytes()) == "iso");
    CHECK((*find_gain_map(made.bytes()))->metadata.max[0] == 3);

    made.map_iso = iso_segment(0x48, { 1, 0 });
    CHECK(found_in(made.bytes()).find("its gain map has a segment of ISO 21496-1 of 13 bytes") == 0);
    made.map_has_xmp = true;
    CHECK(found_in(made.bytes()) == "ultra_hdr");
}

TEST_CASE("Apple's map is told apart")
{
    CHECK(found_in(with_second_image(R"(HDRGainMap:HDRGainMapVersion="65536")")) == "apple");
    CHECK(found_in(with_second_image(R"(apdi:AuxiliaryImageType="urn:com:apple:photo:2020:aux:hdrgainmap")")) ==
          "apple");
    CHECK(found_in(with_second_image(R"(apdi:AuxiliaryImageType="urn:com:apple:photo:2018:aux:portrait")")) == "none");
}

TEST_CASE("photos without a map have none, and one that was cut off is missed")
{
    CHECK(found_in("") == "none");
    CHECK(found_in("II*") == "none");
    CHECK(found_in(plain_jpeg()) == "none");
    const std::string whole = UltraHdrJpeg().bytes();
    const auto photo = jpeg_image_size(whole);
    REQUIRE(photo);
    CHECK(found_in(whole.substr(0, *photo)) == kMissing);

    const ScratchFolder folder;
    const std::string path = folder.file("cut.jpg", whole.substr(0, *photo));
    const auto found = find_gain_map_of_file(path);
    REQUIRE(!found);
    CHECK(found.error().message == kMissing);
    CHECK(find_gain_map_of_file(folder.path("missing.jpg")).error().message == "No such file or directory");
    CHECK(!*find_gain_map_of_file(folder.file("other.tif", "II*")));
    const auto map = find_gain_map_of_file(folder.file("whole.jpg", whole));
    REQUIRE(map);
    CHECK((*map)->jpeg == UltraHdrJpeg().map());
}

TEST_CASE("a file that is cut anywhere has no map, an error, or a map that is cut, too")
{
    const std::string whole = UltraHdrJpeg().bytes();
    const std::size_t photo = *jpeg_image_size(whole);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const std::string result = found_in(whole.substr(0, size));
        INFO(size);
        CHECK((result == "none" || result == kMissing || (size > photo && result == "ultra_hdr")));
    }
}

TEST_CASE("a multi-picture index with numbers that cannot be is survived")
{
    UltraHdrJpeg made;
    made.has_container = false;
    const std::string right = made.bytes();
    const std::size_t index = right.find(std::string("MPF\0", 4)) + 4, entries = index + 8 + 2 + 36 + 4;
    REQUIRE(found_in(right) == "ultra_hdr");
    const auto with = [&](std::size_t at, const std::string& bytes) {
        return found_in(std::string(right).replace(at, bytes.size(), bytes));
    };
    for (const std::size_t at : { index + 4, index + 8 + 2 + 24 + 8, entries + 16 + 4, entries + 16 + 8 })
        for (const std::string& bytes :
             { std::string(4, '\xff'), std::string(4, '\0'), std::string("\x7f\xff\xff\xff") }) {
            INFO(at);
            CHECK(with(at, bytes) == "none");
        }
    CHECK(with(index + 8, "\xff\xff") == "ultra_hdr");                      // more tags than there are
    CHECK(with(index + 8 + 2 + 24 + 4, "\xff\xff\xff\xff") == "ultra_hdr"); // and more entries
    CHECK(with(index, "XX") == "none");
    // The directory within itself, the entries within the directory.
    for (int to = 0; to < 120; ++to) {
        CHECK(with(index + 7, std::string(1, char(to))).size() > 0);
        CHECK(with(index + 8 + 2 + 24 + 8 + 3, std::string(1, char(to))).size() > 0);
    }
}

TEST_CASE("the size of a JPEG counts through its end, with restarts and fill bytes")
{
    const std::string jpeg = plain_jpeg();
    CHECK(jpeg_image_size(jpeg + "more") == jpeg.size());
    CHECK(!jpeg_image_size(jpeg.substr(0, jpeg.size() - 1)));
    using namespace std::string_literals;
    const std::string made = "\xff\xd8\xff\xff\xff\xe1\0\2\xff\xda\0\2 \xff\0 \xff\xd0 \xff\xff\xff\xd9"s;
    CHECK(jpeg_image_size(made + made) == made.size());
    CHECK(!jpeg_image_size("\xff\xd8\xff\xe1\0\1"s));
}
