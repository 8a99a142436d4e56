// SPDX-License-Identifier: Apache-2.0
#include "raw_file/libraw_traps.h"

#include <algorithm>
#include <cstdint>

#include <doctest/doctest.h>

#include "lib/reference/synthetic_dng.h"

using namespace srisp;

namespace {

/// Bytes of a TIFF, number by number.
class TiffText {
public:
    explicit TiffText(bool big) : m_big(big)
    {
        m_bytes = big ? std::string("MM\0*", 4) : std::string("II*\0", 4);
        number(8, 4);
    }
    TiffText& number(std::uint32_t value, int bytes)
    {
        for (int i = 0; i < bytes; ++i)
            m_bytes += char(value >> 8 * (m_big ? bytes - 1 - i : i) & 255);
        return *this;
    }
    TiffText& tag(std::uint32_t tag, std::uint32_t type, std::uint32_t count, std::uint32_t value)
    {
        return number(tag, 2).number(type, 2).number(count, 4).number(value, 4);
    }
    /// A folder of one tag with one value, and the offset of the next folder.
    TiffText& folder(std::uint32_t tag_number, std::uint32_t value, std::uint32_t next)
    {
        constexpr std::uint32_t kLong = 4;
        return number(1, 2).tag(tag_number, kLong, 1, value).number(next, 4);
    }
    TiffText& text(const std::string& bytes)
    {
        m_bytes += bytes;
        return *this;
    }
    const std::string& bytes() const { return m_bytes; }

private:
    bool m_big;
    std::string m_bytes;
};

std::string trap_of(const std::string& bytes)
{
    const std::shared_ptr<unsigned char[]> copy(new unsigned char[bytes.size()]);
    std::copy(bytes.begin(), bytes.end(), copy.get());
    const Status status = check_libraw_traps({ copy, bytes.size() });
    return status ? "" : status.error().message;
}

const std::string kHarm = "is damaged, or made to do harm: ";
const std::string kPattern = kHarm + "it states a mosaic of 36 filters, but not of 6 x 6";

} // namespace

TEST_CASE("A pattern of 36 filters that nothing announces is refused, in both byte orders, under both tags")
{
    for (const bool big : { false, true })
        for (const std::uint32_t tag : { 33422u, 64777u }) {
            CAPTURE(big);
            CAPTURE(tag);
            CHECK(trap_of(TiffText(big).number(1, 2).tag(tag, 1, 36, 8).number(0, 4).bytes()) == kPattern);
            // Of a type that does not exist, which LibRaw does not look at.
            CHECK(trap_of(TiffText(big).number(1, 2).tag(tag, 999, 36, 8).number(0, 4).bytes()) == kPattern);
            // Where only LibRaw finds it.
            CHECK(trap_of(TiffText(big).number(0, 2).number(0, 4).text("odd").tag(tag, 7, 36, 8).bytes()) == kPattern);
        }
    CHECK(trap_of("FUJIFILM" + TiffText(true).tag(33422, 1, 36, 8).bytes()) == kPattern);
}

TEST_CASE("X-Trans and Bayer patterns pass")
{
    SyntheticDng bayer, xtrans;
    xtrans.set(33421, SyntheticDng::kShort, { 6, 6 });
    xtrans.set(33422, SyntheticDng::kByte, std::vector<double>(36, 1));
    for (const bool big : { false, true }) {
        bayer.big_endian = xtrans.big_endian = big;
        CHECK(trap_of(bayer.fill([](int, int, int) { return 1000; }).bytes()) == "");
        CHECK(trap_of(xtrans.fill([](int, int, int) { return 1000; }).bytes()) == "");
    }
    xtrans.set(33421, SyntheticDng::kShort, { 2, 2 });
    CHECK(trap_of(xtrans.bytes()) == kPattern);
}

TEST_CASE("Folders in a loop are refused")
{
    constexpr std::uint32_t kWidth = 256, kSubFolders = 330;
    // The next folder is the first one; a SubIFD is the folder that it belongs to; two that name each other.
    const std::string loop = kHarm + "its TIFF's folders of tags form a loop";
    CHECK(trap_of(TiffText(false).folder(kWidth, 1, 8).bytes()) == loop);
    CHECK(trap_of(TiffText(true).folder(kSubFolders, 8, 0).bytes()) == loop);
    CHECK(trap_of(TiffText(false).folder(kSubFolders, 26, 0).folder(kSubFolders, 8, 0).bytes()) == loop);
    // Two folders that share a third one do not.
    CHECK(
        trap_of(TiffText(false).folder(kSubFolders, 44, 26).folder(kSubFolders, 44, 0).folder(kWidth, 1, 0).bytes()) ==
        "");
}

TEST_CASE("Folders without end are refused: in a chain, nested, of too many tags, linked again and again")
{
    TiffText chain(false), nested(false), large(false), again(false);
    for (std::uint32_t i = 0; i < 100; ++i) {
        chain.number(0, 2).number(8 + 6 * (i + 1), 4);
        nested.folder(330, 8 + 18 * (i + 1), 0);
    }
    CHECK(trap_of(chain.bytes()) == kHarm + "its TIFF has more than 64 folders of tags");
    CHECK(trap_of(nested.bytes()) == kHarm + "its TIFF has folders of tags nested more than 2 deep");
    large.number(600, 2);
    again.number(3, 2).tag(34665, 4, 1, 50).tag(34665, 4, 1, 50).tag(34665, 4, 1, 50).number(0, 4);
    for (std::uint32_t i = 0; i < 600; ++i)
        large.tag(256, 3, 1, i);
    CHECK(trap_of(large.bytes()) == "a folder of its TIFF holds 600 tags, the limit is 512");
    CHECK(trap_of(again.bytes()) == "a folder of its TIFF holds tag 34665 3 times");
}

TEST_CASE("The folders of Olympus's and Panasonic's relatives of TIFF are looked at")
{
    for (const std::string& number : { std::string("IIRO"), std::string("IIRS"), std::string("IIU\0", 4) }) {
        std::string bytes = TiffText(false).folder(256, 1, 8).bytes();
        bytes.replace(0, 4, number);
        CHECK(trap_of(bytes) == kHarm + "its TIFF's folders of tags form a loop");
    }
}

TEST_CASE("Files without anything in them pass: others say what they are")
{
    CHECK(trap_of("") == "");
    CHECK(trap_of(std::string(100, '\0')) == "");
    CHECK(trap_of("$\0\0\0") == "");
}
