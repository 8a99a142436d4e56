// SPDX-License-Identifier: Apache-2.0
#include "dng_settings.h"

#include <algorithm>

#include <OpenImageIO/strutil.h>

#include "base/near_names.h"
#include "base/shown_text.h"

namespace srisp::plugin {

namespace {

namespace Strutil = OIIO::Strutil;

const std::string kPrefix = "dng:";
const char kLayout[] = "dng:layout", kDatatype[] = "dng:datatype", kBits[] = "dng:bits", kQuiet[] = "dng:quiet";

/// The values of an attribute, in the order of its enumeration.
struct Choice {
    const char* name;
    std::vector<std::string> values;
};
const Choice kLayouts{ kLayout, { "standard", "cinema" } };
const Choice kDatatypes{ kDatatype, { "uint16", "half", "float" } };
const Choice kQuiets{ kQuiet, { "0", "1" } };
const Choice kCompressions{ "compression", { "none", "lossless", "deflate" } };

Expected<std::size_t> choose(const Choice& choice, const std::string& text)
{
    const auto found = std::find(choice.values.begin(), choice.values.end(), Strutil::lower(text));
    if (found == choice.values.end())
        return Error{ std::string("unknown ") + choice.name + " '" + shown_text(text) + "'" +
                      near_names(text, choice.values) };
    return std::size_t(found - choice.values.begin());
}

/// `fallback` where the attribute is not there.
Expected<std::size_t> chosen(const OIIO::ImageSpec& spec, const Choice& choice, std::size_t fallback)
{
    const OIIO::ParamValue* const value = spec.find_attribute(choice.name);
    return value ? choose(choice, value->get_string()) : Expected<std::size_t>(fallback);
}

/// Of the formats that OpenImageIO 2.4 reads and writes.
bool is_other_formats(const std::string& compression)
{
    const std::string name = Strutil::lower(compression.substr(0, compression.find(':')));
    static const char* const known[] = { "zip",       "zips",      "rle",      "piz",         "pxr24",
                                         "b44",       "b44a",      "dwaa",     "dwab",        "lzw",
                                         "packbits",  "jpeg",      "webp",     "zfile",       "uncompressed",
                                         "ccittrle",  "ccitt_t4",  "ccitt_t6", "ccittfax3",   "ccittfax4",
                                         "ccitt_t.4", "ccittrle2", "next",     "thunderscan", "adobe_deflate",
                                         "lzma",      "zstd",      "lerc",     "av1",         "hevc",
                                         "heic",      "avif",      "jp2000",   "pixarlog",    "pixarfilm" };
    return std::any_of(std::begin(known), std::end(known), [&](const char* other) { return name == other; });
}

Status check_names(const OIIO::ImageSpec& spec)
{
    const std::vector<std::string> known = { kLayout, kDatatype, kBits, kQuiet };
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
        const std::string name = attribute.name().string();
        if (name.compare(0, kPrefix.size(), kPrefix) == 0 && std::find(known.begin(), known.end(), name) == known.end())
            return Error{ "unknown attribute '" + shown_text(name) + "'" + near_names(name, known) };
    }
    return {};
}

constexpr int kFewestBits = 10, kMostBits = 16;

/// Stock oiiotool takes the second attribute from images.
Status read_bits(const OIIO::ImageSpec& spec, int& bits)
{
    if (const OIIO::ParamValue* const value = spec.find_attribute(kBits)) {
        bits = value->get_int();
        if (bits < kFewestBits || bits > kMostBits)
            return Error{ std::string(kBits) + " '" + shown_text(value->get_string()) +
                          "': from 10 to 16 are possible" };
    } else if (const int said = spec.get_int_attribute("oiio:BitsPerSample");
               said >= kFewestBits && said <= kMostBits) {
        bits = said;
    }
    return {};
}

} // namespace

Expected<DngSettings> read_dng_settings(const OIIO::ImageSpec& spec)
{
    if (const Status names = check_names(spec); !names)
        return names.error();
    const auto layout = chosen(spec, kLayouts, 0);
    const auto datatype = chosen(spec, kDatatypes, 0);
    const auto quiet = chosen(spec, kQuiets, 0);
    for (const auto* choice : { &layout, &datatype, &quiet })
        if (!*choice)
            return choice->error();
    DngSettings settings;
    settings.options.layout = *layout == 1 ? DngLayout::cinema : DngLayout::standard;
    settings.quiet = *quiet == 1;
    settings.floats = *datatype > 0;
    settings.options.compression = settings.floats ? DngCompression::deflate : DngCompression::lossless;
    if (settings.floats)
        settings.options.bits = *datatype == 1 ? 16 : 32;
    else if (const Status bits = read_bits(spec, settings.options.bits); !bits)
        return bits.error();
    const std::string compression = spec.get_string_attribute("compression");
    if (compression.empty() || is_other_formats(compression))
        return settings;
    const auto index = choose(kCompressions, compression);
    if (!index)
        return index.error();
    settings.options.compression = static_cast<DngCompression>(*index);
    return settings;
}

} // namespace srisp::plugin
