// SPDX-License-Identifier: Apache-2.0
#include "container/file_description.h"

#include <cmath>

#include <OpenImageIO/strutil.h>
#include <OpenImageIO/tiffutils.h>

namespace srisp {

namespace {

const char kNotes[] = "srisp:notes";
const char kIcc[] = "ICCProfile", kCicp[] = "CICP", kSpace[] = "oiio:ColorSpace", kGamma[] = "oiio:Gamma",
           kChromaticities[] = "chromaticities";

void erase_color(OIIO::ImageSpec& spec)
{
    for (const char* name : { kIcc, kCicp, kSpace, kGamma, kChromaticities })
        spec.erase_attribute(name);
}

} // namespace

void add_note(OIIO::ImageSpec& spec, const std::string& note)
{
    const std::string before = spec.get_string_attribute(kNotes);
    spec.attribute(kNotes, before + (before.empty() ? "" : "\n") + note);
}

std::vector<std::string> note_list(const OIIO::ImageSpec& spec)
{
    const std::string notes = spec.get_string_attribute(kNotes);
    return notes.empty() ? std::vector<std::string>() : OIIO::Strutil::splits(notes, "\n");
}

void erase_notes(OIIO::ImageSpec& spec)
{
    spec.erase_attribute(kNotes);
}

void set_icc_profile(OIIO::ImageSpec& spec, const void* profile, std::size_t size)
{
    set_color_space(spec, "sRGB"); // no other name says what a profile says
    spec.attribute(kIcc, OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(size)), profile);
}

void set_cicp(OIIO::ImageSpec& spec, const std::array<int, 4>& cicp)
{
    set_color_space(spec, "sRGB");
    spec.attribute(kCicp, OIIO::TypeDesc(OIIO::TypeDesc::INT, 4), cicp.data());
}

void set_color_space(OIIO::ImageSpec& spec, const std::string& name)
{
    erase_color(spec);
    spec.attribute(kSpace, name);
}

void set_gamma(OIIO::ImageSpec& spec, double gamma)
{
    const bool linear = std::fabs(gamma - 1) < 0.01;
    set_color_space(spec, linear ? "Linear" : OIIO::Strutil::sprintf("Gamma%.5g", gamma));
    spec.attribute(kGamma, static_cast<float>(gamma));
}

void set_chromaticities(OIIO::ImageSpec& spec, const std::array<float, 8>& chromaticities)
{
    spec.attribute(kChromaticities, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities.data());
}

void add_exif(OIIO::ImageSpec& spec, const void* exif, std::size_t size)
{
    OIIO::ImageSpec found;
    const auto* bytes = static_cast<const std::uint8_t*>(exif);
    if (!OIIO::decode_exif(OIIO::cspan<std::uint8_t>(bytes, static_cast<std::ptrdiff_t>(size)), found))
        return;
    for (const OIIO::ParamValue& attribute : found.extra_attribs)
        if (!spec.find_attribute(attribute.name()))
            spec.extra_attribs.push_back(attribute);
}

} // namespace srisp
