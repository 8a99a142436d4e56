// SPDX-License-Identifier: Apache-2.0
#include "color/icc_transform.h"

#include <cmath>
#include <string>

#include <lcms2.h>

#include "base/recently_kept.h"
#include "color/icc_header.h"

namespace srisp {

namespace {

/// A context of our own keeps Little CMS from printing or sharing state with the host's use of it.
struct LcmsContext {
    cmsContext context = cmsCreateContext(nullptr, nullptr);
    ~LcmsContext() { cmsDeleteContext(context); }
};

struct Profile {
    cmsHPROFILE handle;
    ~Profile()
    {
        if (handle)
            cmsCloseProfile(handle);
    }
};

/// Grey profiles: one curve, taken from Little CMS at every 16-bit code value.
class GreyTransform : public ColorTransform {
public:
    explicit GreyTransform(const std::function<double(double)>& curve) : m_curve(curve) {}
    std::int64_t apply(float* rgb, std::int64_t pixels) const override
    {
        std::int64_t clipped = 0;
        for (float* p = rgb; p != rgb + pixels * 3; p += 3) {
            p[0] = m_curve(p[0]);
            clipped += clip(p[0]);
            p[1] = p[2] = p[0];
        }
        return clipped;
    }

private:
    CurveTable m_curve;
};

/// Any other RGB profile: Little CMS in float, all of its precision.
class LcmsTransform : public ColorTransform {
public:
    explicit LcmsTransform(std::shared_ptr<LcmsContext> context, cmsHTRANSFORM transform)
        : m_context(std::move(context)), m_transform(transform)
    {
    }
    ~LcmsTransform() override { cmsDeleteTransform(m_transform); }
    std::int64_t apply(float* rgb, std::int64_t pixels) const override
    {
        std::int64_t clipped = 0;
        cmsDoTransform(m_transform, rgb, rgb, static_cast<cmsUInt32Number>(pixels));
        for (float* p = rgb; p != rgb + pixels * 3; ++p)
            clipped += clip(*p);
        return clipped;
    }

private:
    std::shared_ptr<LcmsContext> m_context;
    cmsHTRANSFORM m_transform;
};

/// The colorants of a matrix profile, XYZ (D50) in columns.
bool read_colorants(cmsHPROFILE profile, Matrix3& matrix)
{
    const cmsTagSignature tags[3] = { cmsSigRedColorantTag, cmsSigGreenColorantTag, cmsSigBlueColorantTag };
    for (int c = 0; c < 3; ++c) {
        const auto* xyz = static_cast<const cmsCIEXYZ*>(cmsReadTag(profile, tags[c]));
        if (!xyz)
            return false;
        matrix[c] = static_cast<float>(xyz->X);
        matrix[3 + c] = static_cast<float>(xyz->Y);
        matrix[6 + c] = static_cast<float>(xyz->Z);
    }
    return std::fabs(determinant(matrix)) > 1e-6;
}

/// Null where the profile is not plain curves and matrix, or has tables that take precedence over them (ICC.1 8.10).
ColorTransformPtr matrix_transform(cmsHPROFILE profile, cmsHPROFILE srgb)
{
    if (!cmsIsMatrixShaper(profile) || cmsIsTag(profile, cmsSigAToB0Tag) || cmsIsTag(profile, cmsSigAToB1Tag) ||
        cmsIsTag(profile, cmsSigDToB0Tag) || cmsIsTag(profile, cmsSigDToB1Tag))
        return nullptr;
    Matrix3 to_xyz, srgb_to_xyz;
    if (!read_colorants(profile, to_xyz) || !read_colorants(srgb, srgb_to_xyz))
        return nullptr;
    const cmsTagSignature tags[3] = { cmsSigRedTRCTag, cmsSigGreenTRCTag, cmsSigBlueTRCTag };
    const cmsToneCurve* curves[3];
    for (int c = 0; c < 3; ++c)
        if (!(curves[c] = static_cast<const cmsToneCurve*>(cmsReadTag(profile, tags[c]))))
            return nullptr;
    const auto table = [&](int c) {
        return CurveTable([&](double v) { return cmsEvalToneCurveFloat(curves[c], static_cast<float>(v)); });
    };
    return curves_and_matrix({ table(0), table(1), table(2) }, product(inverse(srgb_to_xyz), to_xyz));
}

Expected<ColorTransformPtr> make_transform(const void* data, std::size_t size, int channels)
{
    const auto header = read_icc_header(data, size);
    if (!header)
        return header.error();
    if (header->color_space != std::uint32_t(channels == 1 ? cmsSigGrayData : cmsSigRgbData))
        return Error{ "its ICC profile is for " + icc_signature_text(header->color_space) + ", the image has " +
                      (channels == 1 ? "grey" : "RGB") + " channels" };
    const auto context = std::make_shared<LcmsContext>();
    const Profile profile{ cmsOpenProfileFromMemTHR(context->context, data, static_cast<cmsUInt32Number>(size)) };
    if (!profile.handle)
        return Error{ "its ICC profile of " + std::to_string(size) + " bytes is damaged" };
    const Profile srgb{ cmsCreate_sRGBProfileTHR(context->context) };
    ColorTransformPtr result;
    if (channels == 3)
        result = matrix_transform(profile.handle, srgb.handle);
    if (!result) {
        const cmsUInt32Number format = channels == 1 ? TYPE_GRAY_FLT : TYPE_RGB_FLT;
        cmsHTRANSFORM transform =
            cmsCreateTransformTHR(context->context, profile.handle, format, srgb.handle, TYPE_RGB_FLT,
                                  INTENT_RELATIVE_COLORIMETRIC, cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE);
        if (!transform)
            return Error{ "its ICC profile is damaged: it gives no transform to sRGB" };
        const auto lcms = std::make_shared<LcmsTransform>(context, transform);
        if (channels == 3) {
            result = lcms;
        } else {
            result = std::make_shared<GreyTransform>([&](double v) {
                const float grey = static_cast<float>(v);
                float rgb[3];
                cmsDoTransform(transform, &grey, rgb, 1);
                return rgb[1];
            });
        }
    }
    if (is_identity(*result, channels))
        result.reset();
    return result;
}

} // namespace

Expected<ColorTransformPtr> color_transform_from_icc(const void* profile, std::size_t size, int channels)
{
    // The tables of a profile take longer than a small photo. Few cameras and programs write most of them.
    constexpr std::size_t kMostKept = 16, kMostBytes = 16 << 10;
    using Kept = std::shared_ptr<const ColorTransformPtr>;
    if (size > kMostBytes)
        return make_transform(profile, size, channels);
    // Never destroyed: other threads may still read while statics end.
    static auto& kept = *new RecentlyKept<Kept>(kMostKept);
    const std::string key = std::to_string(channels) + std::string(static_cast<const char*>(profile), size);
    const auto found = kept.get(key, [&]() -> Expected<Kept> {
        auto made = make_transform(profile, size, channels);
        return made ? Expected<Kept>(std::make_shared<const ColorTransformPtr>(std::move(*made))) : made.error();
    });
    return found ? Expected<ColorTransformPtr>(**found) : found.error();
}

} // namespace srisp
