// SPDX-License-Identifier: Apache-2.0
#include "photo/color_management.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <lcms2.h>

#include "base/matrix3.h"

namespace srisp {

namespace {

/// A curve over [0,1], sampled so that every 16-bit code value is a sample, linear between them.
class Table {
public:
    explicit Table(const std::function<double(double)>& curve) : m_samples(kSteps + 1)
    {
        for (int i = 0; i <= kSteps; ++i)
            m_samples[i] = static_cast<float>(curve(double(i) / kSteps));
    }
    /// `value` in [0,1].
    float operator()(float value) const
    {
        const float position = value * kSteps;
        const int index = std::min(static_cast<int>(position), kSteps - 1);
        return m_samples[index] + (position - index) * (m_samples[index + 1] - m_samples[index]);
    }

private:
    static constexpr int kSteps = 65535;
    std::vector<float> m_samples;
};

double srgb_curve(double v)
{
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

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

bool clip(float& value)
{
    // One 8-bit step is 0.004: rounding of a profile's numbers is no clipping.
    const bool outside = value < -0.002f || value > 1.002f;
    value = std::min(std::max(value, 0.0f), 1.0f);
    return outside;
}

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
    Table m_curve;
};

/// Matrix profiles, which nearly every photo has: Little CMS needs 300 ns per pixel for them in float, and errs by 0.05
/// at the border of the gamut in its fast 16-bit form (measured with Display P3), so curves and matrix are run here: 20
/// ns.
class MatrixTransform : public ColorTransform {
public:
    MatrixTransform(std::array<Table, 3> curves, const Matrix3& to_linear_srgb)
        : m_curves(std::move(curves)), m_matrix(to_linear_srgb)
    {
    }
    std::int64_t apply(float* rgb, std::int64_t pixels) const override
    {
        std::int64_t clipped = 0;
        for (float* p = rgb; p != rgb + pixels * 3; p += 3) {
            const float linear[3] = { m_curves[0](p[0]), m_curves[1](p[1]), m_curves[2](p[2]) };
            for (int c = 0; c < 3; ++c) {
                const float* row = &m_matrix[c * 3];
                float value = row[0] * linear[0] + row[1] * linear[1] + row[2] * linear[2];
                clipped += clip(value);
                p[c] = srgb_encoded(value);
            }
        }
        return clipped;
    }

private:
    std::array<Table, 3> m_curves;
    Matrix3 m_matrix;
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
std::shared_ptr<const ColorTransform> matrix_transform(cmsHPROFILE profile, cmsHPROFILE srgb)
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
        return Table([&](double v) { return cmsEvalToneCurveFloat(curves[c], static_cast<float>(v)); });
    };
    return std::make_shared<MatrixTransform>(std::array<Table, 3>{ table(0), table(1), table(2) },
                                             product(inverse(srgb_to_xyz), to_xyz));
}

/// Whether no colour moves by half an 8-bit step.
bool is_identity(const ColorTransform& transform, int channels)
{
    constexpr int kSteps = 16;
    std::vector<float> grid;
    for (int r = 0; r <= kSteps; ++r)
        for (int g = 0; g <= (channels == 1 ? 0 : kSteps); ++g)
            for (int b = 0; b <= (channels == 1 ? 0 : kSteps); ++b)
                for (const int v : { r, channels == 1 ? r : g, channels == 1 ? r : b })
                    grid.push_back(float(v) / kSteps);
    std::vector<float> moved = grid;
    transform.apply(moved.data(), static_cast<std::int64_t>(moved.size() / 3));
    for (std::size_t i = 0; i < grid.size(); ++i)
        if (std::fabs(moved[i] - grid[i]) > 0.5f / 255)
            return false;
    return true;
}

std::string signature_text(cmsColorSpaceSignature signature)
{
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8)
        text += static_cast<char>(signature >> shift & 0xff);
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

} // namespace

float srgb_encoded(float linear)
{
    static const Table table(srgb_curve);
    return table(std::min(std::max(linear, 0.0f), 1.0f));
}

Expected<std::shared_ptr<const ColorTransform>> color_transform_from_icc(const void* data, std::size_t size,
                                                                         int channels)
{
    const auto context = std::make_shared<LcmsContext>();
    const Profile profile{ cmsOpenProfileFromMemTHR(context->context, data, static_cast<cmsUInt32Number>(size)) };
    if (!profile.handle)
        return Error{ "its ICC profile of " + std::to_string(size) + " bytes is damaged" };
    const cmsColorSpaceSignature space = cmsGetColorSpace(profile.handle);
    if (space != (channels == 1 ? cmsSigGrayData : cmsSigRgbData))
        return Error{ "its ICC profile is for " + signature_text(space) + ", the image has " +
                      (channels == 1 ? "grey" : "RGB") + " channels" };

    const Profile srgb{ cmsCreate_sRGBProfileTHR(context->context) };
    std::shared_ptr<const ColorTransform> result;
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

} // namespace srisp
