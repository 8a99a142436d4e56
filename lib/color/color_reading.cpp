// SPDX-License-Identifier: Apache-2.0
#include "color/color_reading.h"

#include <array>
#include <cmath>
#include <optional>

#include "base/shown_text.h"
#include "color/color_encoding.h"
#include "color/icc_transform.h"

namespace srisp {

namespace {

std::optional<std::array<int, 4>> cicp_of(const OIIO::ImageSpec& spec)
{
    const OIIO::ParamValue* found = spec.find_attribute("CICP", OIIO::TypeDesc(OIIO::TypeDesc::INT, 4));
    if (!found)
        return {};
    const int* numbers = static_cast<const int*>(found->data());
    return std::array<int, 4>{ numbers[0], numbers[1], numbers[2], numbers[3] };
}

std::optional<Chromaticities> chromaticities_of(const OIIO::ImageSpec& spec, std::vector<std::string>& notes)
{
    const OIIO::ParamValue* found = spec.find_attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8));
    if (!found)
        return {};
    Chromaticities chromaticities;
    std::copy_n(static_cast<const float*>(found->data()), 8, chromaticities.begin());
    if (are_usable(chromaticities))
        return chromaticities;
    notes.push_back("its chromaticities are not those of a colour space; taken as sRGB's");
    return {};
}

ColorReading read_encoded(const ColorEncoding& encoding, int channels, std::vector<std::string> notes)
{
    return { transform_of(encoding, channels), std::move(notes) };
}

/// A picture with an exponent of about 2.2 and sRGB's primaries is what programs without colour management call sRGB;
/// with other primaries somebody meant what is written.
void take_gamma_22_as_srgb(ColorEncoding& encoding)
{
    bool primaries_of_srgb = true;
    for (int i = 0; i < 8; ++i)
        primaries_of_srgb &= std::fabs(encoding.chromaticities[i] - kSrgbChromaticities[i]) < 0.002f;
    if (encoding.transfer == Transfer::power && std::fabs(encoding.gamma - 2.2f) < 0.01f && primaries_of_srgb)
        encoding.transfer = Transfer::srgb;
}

/// By the name of its colour space, or where that says no primaries, by its interop identifier: OpenImageIO before 3.1
/// calls every EXR file "Linear".
std::optional<NamedEncoding> most_exact_name(const OIIO::ImageSpec& spec, const std::string& space)
{
    const std::optional<NamedEncoding> named = named_encoding(space);
    if (named && named->says_primaries)
        return named;
    const std::optional<NamedEncoding> identified = named_encoding(spec.get_string_attribute("colorInteropID"));
    const bool agree = identified && (!named || identified->encoding.transfer == named->encoding.transfer);
    return agree && !spec.find_attribute("chromaticities") ? identified : named;
}

} // namespace

ColorReading read_as_srgb()
{
    return {};
}

ColorReading read_as_linear()
{
    ColorEncoding encoding;
    encoding.transfer = Transfer::linear;
    return read_encoded(encoding, 3, {});
}

ColorReading read_as_described(const OIIO::ImageSpec& spec, int channels)
{
    const std::string space = spec.get_string_attribute("oiio:ColorSpace");
    const std::optional<NamedEncoding> named = most_exact_name(spec, space);
    const OIIO::ParamValue* icc = spec.find_attribute("ICCProfile");
    const bool is_float = spec.format.is_floating_point();
    std::vector<std::string> notes;

    if (!named || named->encoding.transfer != Transfer::linear) {
        if (const auto cicp = cicp_of(spec))
            if (const auto encoding = cicp_encoding(*cicp, notes))
                return read_encoded(*encoding, channels, notes);
        if (icc) {
            auto transform = color_transform_from_icc(icc->data(), icc->type().size(), channels);
            if (transform)
                return { *transform, notes };
            notes.push_back(transform.error().message + "; it was ignored");
        }
    } else if (icc) {
        // A program that made the image linear kept the profile of what it was before.
        notes.push_back("the ICC profile was ignored, since the image says that it is linear");
    }

    ColorEncoding encoding;
    if (named)
        encoding = named->encoding;
    else if (is_float)
        encoding.transfer = Transfer::linear;
    if (!named || !named->says_primaries)
        if (const auto chromaticities = chromaticities_of(spec, notes))
            encoding.chromaticities = *chromaticities;
    take_gamma_22_as_srgb(encoding);
    if (!named && !space.empty())
        notes.push_back("the colour space '" + shown_text(space) + "' is not known; taken as " +
                        (encoding.transfer == Transfer::linear ? "linear sRGB" : "display-encoded sRGB"));
    // EXIF says "uncalibrated" for Adobe RGB, and OpenImageIO does not show the interoperability index that tells.
    if (encoding.transfer != Transfer::linear && spec.get_int_attribute("Exif:ColorSpace", 1) == 65535 && !icc)
        notes.push_back("EXIF says that the colour space is not sRGB, and no ICC profile tells which; taken as "
                        "display-encoded sRGB");
    return read_encoded(encoding, channels, std::move(notes));
}

} // namespace srisp
