// SPDX-License-Identifier: Apache-2.0
#include "record/private_facts.h"

#include <algorithm>
#include <cstring>
#include <iterator>

#include <OpenImageIO/strutil.h>

namespace srisp {

namespace {

namespace Strutil = OIIO::Strutil;

// Of names as readers, and XMP that readers flatten, have them.
const char* const kBeginnings[] = { "drone-",  "HostComputer", "MicrosoftPhoto:", "MP:",  "MPRI:",
                                    "MPReg:",  "mwg-rs:",      "Raw profile",     "rdf:", "stArea:",
                                    "stEvt:",  "stMfs:",       "stRef:",          "XML:", "xmpMM:",
                                    "preview", "thumbnail_",   "Thumb::",         "XMP" };
const char* const kParts[] = { "gps",        "serial",     "ownername",     "makernote", "uniqueid",
                               "documentid", "instanceid", "personinimage", "geotag" };
// Behind the last colon, of a place.
const char* const kPlaces[] = {
    "City",        "Country",      "CountryCode",     "CountryName",         "Location",
    "State",       "LocationName", "ProvinceState",   "ContentLocationCode", "ContentLocationName",
    "Sublocation", "WorldRegion",  "LocationCreated", "LocationShown"
};
// Texts that tell of the making, and name files.
const char* const kTellFiles[] = { "Software", "Exif:ImageHistory", "DocumentName" };

/// Behind which an absolute path may begin.
bool may_precede_path(char c)
{
    return std::strchr(" \t\n=;:,@('\"", c) != nullptr;
}

} // namespace

bool is_private_fact(const std::string& name)
{
    const std::string lower = Strutil::lower(name);
    const std::string last = name.substr(name.rfind(':') + 1);
    return std::any_of(std::begin(kBeginnings), std::end(kBeginnings),
                       [&](const char* beginning) { return Strutil::istarts_with(name, beginning); }) ||
           std::any_of(std::begin(kParts), std::end(kParts),
                       [&](const char* part) { return lower.find(part) != std::string::npos; }) ||
           std::any_of(std::begin(kPlaces), std::end(kPlaces),
                       [&](const char* place) { return Strutil::iequals(last, place); });
}

std::string without_folders(const std::string& text)
{
    std::string result;
    char quote = 0; // that a shell's word is in
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '\'' || c == '"')
            quote = quote == 0 ? c : quote == c ? '\0' : quote;
        const bool begins = c == '/' && (i == 0 || may_precede_path(text[i - 1])) && text[i + 1] != '/';
        if (!begins) {
            result += c;
            continue;
        }
        const std::string ends = quote ? std::string(";:,\n") + quote : std::string(" \t\n;:,)'\"");
        const std::size_t end = std::min(text.find_first_of(ends, i), text.size());
        std::size_t last = text.find_last_not_of('/', end - 1); // "/a/b/" is called b
        last = last == std::string::npos || last < i ? i : text.rfind('/', last) + 1;
        result += text.substr(last, end - last);
        i = end - 1;
    }
    return result;
}

void erase_private_facts(OIIO::ImageSpec& spec)
{
    auto& attributes = spec.extra_attribs;
    for (auto at = attributes.begin(); at != attributes.end();)
        at = is_private_fact(at->name().string()) ? attributes.erase(at) : at + 1;
    for (const char* name : kTellFiles)
        if (const std::string text = spec.get_string_attribute(name); !text.empty())
            spec.attribute(name, without_folders(text));
}

} // namespace srisp
