// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <lcms2.h>

namespace srisp {

/// Closes the profile.
inline std::vector<unsigned char> profile_bytes(cmsHPROFILE profile)
{
    cmsUInt32Number size = 0;
    cmsSaveProfileToMem(profile, nullptr, &size);
    std::vector<unsigned char> bytes(size);
    cmsSaveProfileToMem(profile, bytes.data(), &size);
    cmsCloseProfile(profile);
    return bytes;
}

/// A matrix profile with one exponent.
inline std::vector<unsigned char> rgb_profile(const cmsCIExyYTRIPLE& primaries, double exponent)
{
    const cmsCIExyY white = { 0.3127, 0.3290, 1 };
    cmsToneCurve* gamma = cmsBuildGamma(nullptr, exponent);
    cmsToneCurve* curves[3] = { gamma, gamma, gamma };
    const auto bytes = profile_bytes(cmsCreateRGBProfile(&white, &primaries, curves));
    cmsFreeToneCurve(gamma);
    return bytes;
}

inline std::vector<unsigned char> adobe_rgb()
{
    return rgb_profile({ { 0.64, 0.33, 1 }, { 0.21, 0.71, 1 }, { 0.15, 0.06, 1 } }, 2.19921875);
}

inline std::vector<unsigned char> grey_gamma(double gamma)
{
    cmsToneCurve* curve = cmsBuildGamma(nullptr, gamma);
    const auto bytes = profile_bytes(cmsCreateGrayProfile(cmsD50_xyY(), curve));
    cmsFreeToneCurve(curve);
    return bytes;
}

} // namespace srisp
