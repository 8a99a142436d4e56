// SPDX-License-Identifier: Apache-2.0
#include "operators.h"

namespace srisp {

namespace OCIO = OCIO_NAMESPACE;

namespace {

OCIO::TransformRcPtr transform_of(const Clamp& clamp)
{
    auto range = OCIO::RangeTransform::Create();
    range->setMinInValue(clamp.low);
    range->setMinOutValue(clamp.low);
    range->setMaxInValue(clamp.high);
    range->setMaxOutValue(clamp.high);
    return range;
}

OCIO::TransformRcPtr transform_of(const Limit& limit)
{
    auto range = OCIO::RangeTransform::Create();
    range->setMaxInValue(limit.high);
    range->setMaxOutValue(limit.high);
    return range;
}

OCIO::TransformRcPtr transform_of(const Power& power)
{
    auto exponent = OCIO::ExponentTransform::Create();
    exponent->setValue({ power.exponent, power.exponent, power.exponent, 1 });
    return exponent;
}

OCIO::TransformRcPtr transform_of(const Affine& affine)
{
    double m44[16] = { 0 }, offset4[4] = { 0 };
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            m44[row * 4 + column] = affine.matrix[row * 3 + column];
        offset4[row] = affine.offset[row];
    }
    m44[15] = 1;
    auto matrix = OCIO::MatrixTransform::Create();
    matrix->setMatrix(m44);
    matrix->setOffset(offset4);
    return matrix;
}

OCIO::TransformRcPtr transform_of(const Curves& curves)
{
    auto lut = OCIO::Lut1DTransform::Create(curves.size, false);
    lut->setInterpolation(OCIO::INTERP_LINEAR);
    const float* rgb = curves.rgb.data();
    for (int i = 0; i < curves.size; ++i, rgb += 3)
        lut->setValue(i, rgb[0], rgb[1], rgb[2]);
    return lut;
}

OCIO::TransformRcPtr transform_of(const Cube& cube)
{
    auto lut = OCIO::Lut3DTransform::Create(cube.size);
    lut->setInterpolation(OCIO::INTERP_TETRAHEDRAL);
    const float* rgb = cube.rgb.data();
    for (int r = 0; r < cube.size; ++r)
        for (int g = 0; g < cube.size; ++g)
            for (int b = 0; b < cube.size; ++b, rgb += 3)
                lut->setValue(r, g, b, rgb[0], rgb[1], rgb[2]);
    return lut;
}

} // namespace

OCIO::GroupTransformRcPtr ocio_group(const Operators& operators)
{
    auto group = OCIO::GroupTransform::Create();
    for (const Operator& op : operators)
        group->appendTransform(std::visit([](const auto& each) { return transform_of(each); }, op));
    return group;
}

} // namespace srisp
