// SPDX-License-Identifier: Apache-2.0
#include "color/color_transform.h"

#include <algorithm>
#include <cmath>

#include "base/colorimetry.h"

namespace srisp {

namespace {

/// Encoded values of one pixel, from its linear light; returns how many were clipped.
int encode(const Matrix3& matrix, const float linear[3], float* rgb)
{
    int clipped = 0;
    for (int c = 0; c < 3; ++c) {
        const float* row = &matrix[c * 3];
        float value = row[0] * linear[0] + row[1] * linear[1] + row[2] * linear[2];
        clipped += clip(value);
        rgb[c] = srgb_encoded(value);
    }
    return clipped;
}

class CurvesAndMatrix : public ColorTransform {
public:
    CurvesAndMatrix(std::array<CurveTable, 3> curves, const Matrix3& matrix)
        : m_curves(std::move(curves)), m_matrix(matrix)
    {
    }
    std::int64_t apply(float* rgb, std::int64_t pixels) const override
    {
        std::int64_t clipped = 0;
        for (float* p = rgb; p != rgb + pixels * 3; p += 3) {
            const float linear[3] = { m_curves[0](p[0]), m_curves[1](p[1]), m_curves[2](p[2]) };
            clipped += encode(m_matrix, linear, p);
        }
        return clipped;
    }

private:
    std::array<CurveTable, 3> m_curves;
    Matrix3 m_matrix;
};

class LinearMatrix : public ColorTransform {
public:
    explicit LinearMatrix(const Matrix3& matrix) : m_matrix(matrix) {}
    bool takes_unbounded() const override { return true; }
    std::int64_t apply(float* rgb, std::int64_t pixels) const override
    {
        std::int64_t clipped = 0;
        for (float* p = rgb; p != rgb + pixels * 3; p += 3) {
            const float linear[3] = { p[0], p[1], p[2] };
            clipped += encode(m_matrix, linear, p);
        }
        return clipped;
    }

private:
    Matrix3 m_matrix;
};

class PlainMatrix : public ColorTransform {
public:
    explicit PlainMatrix(const Matrix3& matrix) : m_matrix(matrix) {}
    bool takes_unbounded() const override { return true; }
    std::int64_t apply(float* rgb, std::int64_t pixels) const override
    {
        std::int64_t clipped = 0;
        for (float* p = rgb; p != rgb + pixels * 3; p += 3) {
            const Vector3 values = product(m_matrix, Vector3{ p[0], p[1], p[2] });
            std::copy(values.begin(), values.end(), p);
            for (int c = 0; c < 3; ++c)
                clipped += clip(p[c]);
        }
        return clipped;
    }

private:
    Matrix3 m_matrix;
};

} // namespace

CurveTable::CurveTable(const std::function<double(double)>& curve) : m_samples(kSteps + 1)
{
    for (int i = 0; i <= kSteps; ++i)
        m_samples[i] = static_cast<float>(curve(double(i) / kSteps));
}

float srgb_encoded(float linear)
{
    static const CurveTable table(srgb_curve);
    return table(std::min(std::max(linear, 0.0f), 1.0f));
}

float srgb_decoded(float encoded)
{
    static const CurveTable table(srgb_curve_back);
    return table(encoded);
}

ColorTransformPtr curves_and_matrix(std::array<CurveTable, 3> to_linear, const Matrix3& to_linear_srgb)
{
    return std::make_shared<CurvesAndMatrix>(std::move(to_linear), to_linear_srgb);
}

ColorTransformPtr linear_matrix(const Matrix3& to_linear_srgb)
{
    return std::make_shared<LinearMatrix>(to_linear_srgb);
}

ColorTransformPtr plain_matrix(const Matrix3& matrix)
{
    return std::make_shared<PlainMatrix>(matrix);
}

bool is_identity(const ColorTransform& transform, int channels)
{
    constexpr int kSteps = 16;
    constexpr float kMost = 0.75f / 255;
    std::vector<float> grid;
    for (int r = 0; r <= kSteps; ++r)
        for (int g = 0; g <= (channels == 1 ? 0 : kSteps); ++g)
            for (int b = 0; b <= (channels == 1 ? 0 : kSteps); ++b)
                for (const int v : { r, channels == 1 ? r : g, channels == 1 ? r : b })
                    grid.push_back(float(v) / kSteps);
    std::vector<float> moved = grid;
    transform.apply(moved.data(), static_cast<std::int64_t>(moved.size() / 3));
    for (std::size_t i = 0; i < grid.size(); ++i)
        if (std::fabs(moved[i] - grid[i]) > kMost)
            return false;
    return true;
}

} // namespace srisp
