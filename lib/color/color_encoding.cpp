// SPDX-License-Identifier: Apache-2.0
#include "color/color_encoding.h"

#include <algorithm>
#include <cmath>

#include <OpenImageIO/strutil.h>

#include "base/parsed_number.h"
#include "base/scene_linear_space.h"

namespace srisp {

namespace {

namespace Strutil = OIIO::Strutil;

constexpr Chromaticities kAdobeRgb{ 0.64f, 0.33f, 0.21f, 0.71f, 0.15f, 0.06f, 0.3127f, 0.3290f };

struct Name {
    const char* name;
    Transfer transfer;
    float gamma;
    const Chromaticities* chromaticities; ///< null: the name does not say
};
constexpr Name kNames[] = {
    { "sRGB", Transfer::srgb, 1, nullptr },
    { "Rec709", Transfer::srgb, 1, nullptr },
    { "GammaCorrected", Transfer::srgb, 1, nullptr },
    { "g22_rec709", Transfer::srgb, 1, nullptr },
    { "srgb_texture", Transfer::srgb, 1, nullptr },
    { "srgb_rec709_scene", Transfer::srgb, 1, nullptr },
    { "srgb_rec709_display", Transfer::srgb, 1, nullptr },
    { "out_srgb", Transfer::srgb, 1, nullptr },
    { "Utility - sRGB - Texture", Transfer::srgb, 1, nullptr },
    { "sRGB - Texture", Transfer::srgb, 1, nullptr },
    { "sRGB Encoded Rec.709 (sRGB)", Transfer::srgb, 1, nullptr },
    { "AdobeRGB", Transfer::power, 563 / 256.0f, &kAdobeRgb },
    { "Linear", Transfer::linear, 1, nullptr },
    { "scene_linear", Transfer::linear, 1, nullptr },
    { "rendering", Transfer::linear, 1, nullptr },
    { "lin_adobergb", Transfer::linear, 1, &kAdobeRgb },
    { "Linear AdobeRGB", Transfer::linear, 1, &kAdobeRgb },
};

/// The exponent in "Gamma1.8" or "GammaCorrected1.8", as OpenImageIO's readers write it.
std::optional<float> gamma_in_name(const std::string& name)
{
    for (const char* prefix : { "GammaCorrected", "Gamma" }) {
        if (!Strutil::istarts_with(name, prefix))
            continue;
        const auto gamma = parsed_number<float>(name.substr(std::string_view(prefix).size()));
        if (gamma && *gamma > 0.01f && *gamma < 100)
            return gamma;
    }
    return {};
}

struct CicpPrimaries {
    int code;
    Chromaticities chromaticities;
};
constexpr CicpPrimaries kCicpPrimaries[] = {
    { 1, kSrgbChromaticities },
    { 4, { 0.67f, 0.33f, 0.21f, 0.71f, 0.14f, 0.08f, 0.310f, 0.316f } },
    { 5, { 0.64f, 0.33f, 0.29f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f } },
    { 6, { 0.630f, 0.340f, 0.310f, 0.595f, 0.155f, 0.070f, 0.3127f, 0.3290f } },
    { 7, { 0.630f, 0.340f, 0.310f, 0.595f, 0.155f, 0.070f, 0.3127f, 0.3290f } },
    { 8, { 0.681f, 0.319f, 0.243f, 0.692f, 0.145f, 0.049f, 0.310f, 0.316f } },
    { 9, kRec2020Chromaticities },
    { 10, { 1, 0, 0, 1, 0, 0, 1.0f / 3, 1.0f / 3 } },
    { 11, { 0.680f, 0.320f, 0.265f, 0.690f, 0.150f, 0.060f, 0.314f, 0.351f } },
    { 12, kP3D65Chromaticities },
    { 22, { 0.630f, 0.340f, 0.295f, 0.605f, 0.155f, 0.077f, 0.3127f, 0.3290f } },
};

struct CicpTransfer {
    int code;
    Transfer transfer;
    float gamma;
};
constexpr CicpTransfer kCicpTransfers[] = {
    { 1, Transfer::srgb, 1 },   { 4, Transfer::power, 2.2f },  { 5, Transfer::power, 2.8f }, { 6, Transfer::srgb, 1 },
    { 8, Transfer::linear, 1 }, { 13, Transfer::srgb, 1 },     { 14, Transfer::srgb, 1 },    { 15, Transfer::srgb, 1 },
    { 16, Transfer::pq, 1 },    { 17, Transfer::power, 2.6f }, { 18, Transfer::hlg, 1 },
};
constexpr int kUnspecified = 2;

/// In units of the reference white of 203 cd/m² [ITU-R BT.2408].
constexpr double kReferenceWhite = 203;

double pq_to_linear(double v)
{
    constexpr double m1 = 0.1593017578125, m2 = 78.84375, c1 = 0.8359375, c2 = 18.8515625, c3 = 18.6875;
    const double root = std::pow(v, 1 / m2);
    return std::pow(std::max(root - c1, 0.0) / (c2 - c3 * root), 1 / m1) * 10000 / kReferenceWhite;
}

/// On a display of 1000 cd/m²; its system gamma is taken channel by channel, which is exact for greys.
double hlg_to_linear(double v)
{
    constexpr double a = 0.17883277, b = 0.28466892, c = 0.55991073;
    const double scene = v <= 0.5 ? v * v / 3 : (std::exp((v - c) / a) + b) / 12;
    return std::pow(scene, 1.2) * 1000 / kReferenceWhite;
}

double to_linear(const ColorEncoding& encoding, double v)
{
    switch (encoding.transfer) {
    case Transfer::srgb:
        return srgb_decoded(static_cast<float>(v));
    case Transfer::power:
        return std::pow(v, double(encoding.gamma));
    case Transfer::pq:
        return pq_to_linear(v);
    case Transfer::hlg:
        return hlg_to_linear(v);
    case Transfer::linear:
        break;
    }
    return v;
}

/// Linear RGB of the chromaticities → linear sRGB.
Matrix3 to_linear_srgb(const Chromaticities& from)
{
    const Matrix3 adapted = product(adaptation(white_of(from), white_of(kSrgbChromaticities)), rgb_to_xyz(from));
    return row_normalized(product(inverse(rgb_to_xyz(kSrgbChromaticities)), adapted));
}

} // namespace

std::optional<NamedEncoding> named_encoding(const std::string& name)
{
    for (const Name& known : kNames)
        if (Strutil::iequals(name, known.name))
            return NamedEncoding{ { known.transfer, known.gamma,
                                    known.chromaticities ? *known.chromaticities : kSrgbChromaticities },
                                  known.chromaticities != nullptr };
    const SceneLinearSpace* const space = find_scene_linear_space(name);
    if (space && !(space->white == white_of(space->chromaticities)))
        return {}; // XYZ: no RGB
    if (space)
        return NamedEncoding{ { Transfer::linear, 1, space->chromaticities }, true };
    if (const auto gamma = gamma_in_name(name))
        return NamedEncoding{ { Transfer::power, *gamma, kSrgbChromaticities }, false };
    return {};
}

std::optional<ColorEncoding> cicp_encoding(const std::array<int, 4>& cicp, std::vector<std::string>& notes)
{
    if (cicp[0] == kUnspecified && cicp[1] == kUnspecified)
        return {};
    ColorEncoding encoding;
    const auto primaries = std::find_if(std::begin(kCicpPrimaries), std::end(kCicpPrimaries),
                                        [&](const CicpPrimaries& known) { return known.code == cicp[0]; });
    if (primaries != std::end(kCicpPrimaries))
        encoding.chromaticities = primaries->chromaticities;
    else if (cicp[0] != kUnspecified)
        notes.push_back("colour primaries " + std::to_string(cicp[0]) + " of its CICP are not known; taken as sRGB's");
    const auto transfer = std::find_if(std::begin(kCicpTransfers), std::end(kCicpTransfers),
                                       [&](const CicpTransfer& known) { return known.code == cicp[1]; });
    if (transfer != std::end(kCicpTransfers)) {
        encoding.transfer = transfer->transfer;
        encoding.gamma = transfer->gamma;
    } else if (cicp[1] != kUnspecified) {
        notes.push_back("transfer function " + std::to_string(cicp[1]) + " of its CICP is not known; taken as sRGB's");
    }
    if (encoding.transfer == Transfer::pq || encoding.transfer == Transfer::hlg)
        notes.push_back(std::string("is an HDR image (") + (encoding.transfer == Transfer::pq ? "PQ" : "HLG") +
                        "); 203 cd/m² was taken as white, and what is brighter was clipped");
    return encoding;
}

bool are_usable(const Chromaticities& c)
{
    for (const float number : c)
        if (!std::isfinite(number) || std::fabs(number) > 10)
            return false;
    if (c[6] <= 0 || c[7] <= 0 || std::fabs(determinant(primaries_matrix(c))) < 1e-4)
        return false;
    // White must lie among the primaries, and every colour must have a place in sRGB.
    const Matrix3 matrix = to_linear_srgb(c);
    const Matrix3 xyz = rgb_to_xyz(c);
    return std::all_of(matrix.begin(), matrix.end(), [](float v) { return std::isfinite(v) && std::fabs(v) < 100; }) &&
           xyz[3] + xyz[4] + xyz[5] > 0.5f;
}

ColorTransformPtr transform_of(const ColorEncoding& encoding, int channels)
{
    constexpr Matrix3 identity{ 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    const Matrix3 matrix = channels == 1 || encoding.chromaticities == kSrgbChromaticities
                               ? identity
                               : to_linear_srgb(encoding.chromaticities);
    if (encoding.transfer == Transfer::srgb && matrix == identity)
        return nullptr;
    if (encoding.transfer == Transfer::linear)
        return linear_matrix(matrix);
    const CurveTable table([&](double v) { return to_linear(encoding, v); });
    const ColorTransformPtr transform = curves_and_matrix({ table, table, table }, matrix);
    return is_identity(*transform, channels) ? nullptr : transform;
}

} // namespace srisp
