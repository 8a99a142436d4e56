// SPDX-License-Identifier: Apache-2.0
#include "gain_map/gain_map_metadata.h"

#include <doctest/doctest.h>

#include "ultra_hdr_jpeg.h"

using namespace srisp;

namespace {

using Rgb = std::array<double, 3>;

Expected<GainMapMetadata> from_xmp(const std::string& attributes, const std::string& elements = "")
{
    const std::string segment = xmp_segment(attributes, elements);
    const auto xmp = XmpPacket::parse(segment.substr(segment.find('\0') + 1));
    REQUIRE(xmp);
    return gain_map_metadata_from_xmp(*xmp);
}

std::string error_of(const Expected<GainMapMetadata>& metadata)
{
    return metadata ? "" : metadata.error().message;
}

/// With GainMapMax and one more attribute.
std::string error_with(const std::string& attribute)
{
    return error_of(from_xmp(R"(hdrgm:Version="1.0" hdrgm:GainMapMax="2" hdrgm:HDRCapacityMax="2" )" + attribute));
}

Expected<GainMapMetadata> from_iso(const std::string& segment)
{
    return gain_map_metadata_from_iso(std::string_view(segment).substr(segment.find('\0') + 1));
}

} // namespace

TEST_CASE("metadata of Ultra HDR is read from attributes and elements, and has the standard's defaults")
{
    const auto given = from_xmp(R"(hdrgm:Version="1.0" hdrgm:GainMapMin="-0.5" hdrgm:GainMapMax=" +2.5 "
        hdrgm:Gamma="1.25" hdrgm:HDRCapacityMin="0.25" hdrgm:BaseRenditionIsHDR="True")",
                                "<hdrgm:OffsetSDR><rdf:Seq><rdf:li>1e-3</rdf:li><rdf:li>2e-3</rdf:li>"
                                "<rdf:li>3e-3</rdf:li></rdf:Seq></hdrgm:OffsetSDR>"
                                "<hdrgm:OffsetHDR>0</hdrgm:OffsetHDR><hdrgm:HDRCapacityMax>3</hdrgm:HDRCapacityMax>");
    REQUIRE_MESSAGE(given, error_of(given));
    CHECK(given->min == Rgb{ -0.5, -0.5, -0.5 });
    CHECK(given->max == Rgb{ 2.5, 2.5, 2.5 });
    CHECK(given->gamma == Rgb{ 1.25, 1.25, 1.25 });
    CHECK(given->offset_sdr == Rgb{ 1e-3, 2e-3, 3e-3 });
    CHECK(given->offset_hdr == Rgb{ 0, 0, 0 });
    CHECK(given->sdr_headroom == 0.25);
    CHECK(given->hdr_headroom == 3);
    CHECK(given->base_is_hdr);

    const auto defaults = from_xmp(R"(hdrgm:Version="1.0" hdrgm:GainMapMax="1" hdrgm:HDRCapacityMax="1")");
    REQUIRE(defaults);
    CHECK(defaults->min == Rgb{ 0, 0, 0 });
    CHECK(defaults->gamma == Rgb{ 1, 1, 1 });
    CHECK(defaults->offset_sdr == Rgb{ 0.015625, 0.015625, 0.015625 });
    CHECK(defaults->offset_hdr == defaults->offset_sdr);
    CHECK(defaults->sdr_headroom == 0);
    CHECK(!defaults->base_is_hdr);
    CHECK(defaults->in_colors_of_base);
}

TEST_CASE("the prefix of a namespace may be any")
{
    const auto xmp = XmpPacket::parse(R"(<r xmlns:g="http://ns.adobe.com/hdr-gain-map/1.0/" g:Version="1.0"
        g:GainMapMax="3" g:HDRCapacityMax="3" hdrgm:GainMapMax="4"/>)");
    REQUIRE(xmp);
    const auto metadata = gain_map_metadata_from_xmp(*xmp);
    REQUIRE(metadata);
    CHECK(metadata->max[0] == 3);
}

TEST_CASE("XMP without the numbers it needs is an error that names them")
{
    CHECK(error_of(from_xmp("")) == "its gain map lacks Version");
    CHECK(error_of(from_xmp(R"(hdrgm:Version="2.0")")) ==
          "its gain map is of version '2.0'; 1.0 is what this program knows");
    CHECK(error_of(from_xmp(R"(hdrgm:Version="1.0" hdrgm:HDRCapacityMax="1")")) == "its gain map lacks GainMapMax");
    CHECK(error_of(from_xmp(R"(hdrgm:Version="1.0" hdrgm:GainMapMax="1")")) == "its gain map lacks HDRCapacityMax");
    CHECK(error_with(R"(hdrgm:Gamma="0")") ==
          "its gain map has Gamma = 0.000000; from 0.010000 to 100.000000 is possible");
    CHECK(error_with(R"(hdrgm:GainMapMin="3")") ==
          "its gain map has GainMapMax = 2.000000; from 3.000000 to 32.000000 is possible");
    CHECK(error_with(R"(hdrgm:BaseRenditionIsHDR="maybe")") ==
          "its gain map has BaseRenditionIsHDR = 'maybe'; True or False is possible");
    for (const std::string text : { "", " ", "nan", "inf", "-inf", "1e999", "1,5", "1 2", "0x1", "+-1", "one" })
        CHECK(error_with("hdrgm:OffsetSDR=\"" + text + "\"") ==
              "its gain map has OffsetSDR = '" + text + "', which is no number");
    for (const char* text : { "-1", "1e30", "-0.0" })
        CHECK(error_with(std::string("hdrgm:Gamma=\"") + text + "\"").find("its gain map has Gamma = ") == 0);
    CHECK(error_of(from_xmp(R"(hdrgm:Version="1.0")", "<hdrgm:GainMapMax><rdf:Seq><rdf:li>1</rdf:li><rdf:li>1</rdf:li>"
                                                      "</rdf:Seq></hdrgm:GainMapMax>")) ==
          "its gain map has 2 values of GainMapMax; 1 or 3 are possible");
}

TEST_CASE("what is no XML is no XMP")
{
    CHECK(!XmpPacket::parse(""));
    CHECK(!XmpPacket::parse("<a"));
    CHECK(!XmpPacket::parse(std::string(5, '\0')));
    std::string deep;
    for (int i = 0; i < 100000; ++i)
        deep += "<a>";
    CHECK(!XmpPacket::parse(deep));
}

TEST_CASE("metadata of ISO 21496-1 is read with one denominator and with many, of one channel and of three")
{
    const std::vector<std::int64_t> one{ 1, 2, 3, 1, /**/ -1, 4, 5, 2, 11, 5, 1, 64, -1, 32 };
    const auto single = from_iso(iso_segment(0x40, one));
    REQUIRE_MESSAGE(single, error_of(single));
    CHECK(single->sdr_headroom == 0.5);
    CHECK(single->hdr_headroom == 3);
    CHECK(single->min == Rgb{ -0.25, -0.25, -0.25 });
    CHECK(single->max == Rgb{ 2.5, 2.5, 2.5 });
    CHECK(single->gamma == Rgb{ 2.2, 2.2, 2.2 });
    CHECK(single->offset_sdr == Rgb{ 1. / 64, 1. / 64, 1. / 64 });
    CHECK(single->offset_hdr == Rgb{ -1. / 32, -1. / 32, -1. / 32 });
    CHECK(!single->base_is_hdr);
    CHECK(single->in_colors_of_base);

    const auto triple =
        from_iso(iso_segment(0x88, { 10, 0, 30, -10, 20, 10, 1, 2, /**/ -11, 21, 11, 3, 4, /**/ -12, 22, 12, 5, 6 }));
    REQUIRE_MESSAGE(triple, error_of(triple));
    CHECK(triple->hdr_headroom == 3);
    CHECK(triple->min == Rgb{ -1, -1.1, -1.2 });
    CHECK(triple->max == Rgb{ 2, 2.1, 2.2 });
    CHECK(triple->gamma == Rgb{ 1, 1.1, 1.2 });
    CHECK(triple->offset_sdr == Rgb{ 0.1, 0.3, 0.5 });
    CHECK(triple->offset_hdr == Rgb{ 0.2, 0.4, 0.6 });
    CHECK(!triple->in_colors_of_base);

    const auto hdr_base = from_iso(iso_segment(0x48, { 1, 3, 0, 0, 2, 1, 0, 0 }));
    REQUIRE(hdr_base);
    CHECK(hdr_base->base_is_hdr);
}

TEST_CASE("ISO 21496-1 that is cut, unknown or divided by 0 is an error")
{
    const std::string whole = iso_segment(0x40, { 0, 1, 2, 1, 0, 1, 2, 1, 1, 1, 0, 1, 0, 1 });
    REQUIRE(from_iso(whole));
    const std::size_t name = whole.find('\0') + 1;
    for (std::size_t size = name; size < whole.size(); ++size)
        CHECK(error_of(from_iso(whole.substr(0, size))) == "its gain map has a segment of ISO 21496-1 of " +
                                                               std::to_string(size - name) +
                                                               " bytes, which ends too early");
    std::string newer = whole;
    newer[name + 1] = 1;
    CHECK(error_of(from_iso(newer)) == "its gain map needs version 1 of ISO 21496-1; 0 is what this program knows");
    // Each denominator in turn: two headrooms, five numbers.
    for (std::size_t i = 0; i < 7; ++i) {
        std::string divided_by_0 = whole;
        divided_by_0[name + 5 + 8 * i + 7] = 0;
        CHECK(!from_iso(divided_by_0));
    }
    CHECK(!from_iso(iso_segment(0x48, { 0, 0, 2, 0, 2, 1, 0, 0 })));
}
