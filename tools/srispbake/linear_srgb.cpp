// SPDX-License-Identifier: Apache-2.0
#include "linear_srgb.h"

#include <cmath>
#include <vector>

#include "../common/failure.h"
#include "base/matrix3.h"
#include "base/near_names.h"

namespace srisp::tool {

namespace OCIO = OCIO_NAMESPACE;

namespace {

// As the ACES, Blender and other configs call it; aliases are found, too.
const char* const kUsualNames[] = { "Linear Rec.709 (sRGB)",
                                    "lin_rec709_srgb",
                                    "lin_rec709",
                                    "lin_srgb",
                                    "Linear sRGB",
                                    "Utility - Linear - sRGB",
                                    "Utility - Linear - Rec.709",
                                    "Linear Rec.709",
                                    "Linear BT.709",
                                    "linear_srgb",
                                    "Linear" };
const char kInterchange[] = "aces_interchange", kReference[] = "srisp reference space";

std::array<double, 3> apply(const OCIO::ConstCPUProcessorRcPtr& processor, std::array<float, 3> rgb)
{
    processor->applyRGB(rgb.data());
    return { rgb[0], rgb[1], rgb[2] };
}

/// The matrix that a processor is; fails where it is none.
std::array<double, 9> matrix_of(const OCIO::ConstProcessorRcPtr& processor, const std::string& name)
{
    const auto cpu = processor->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS);
    std::array<double, 9> matrix;
    for (int column = 0; column < 3; ++column) {
        std::array<float, 3> unit{};
        unit[std::size_t(column)] = 1;
        const auto values = apply(cpu, unit);
        for (int row = 0; row < 3; ++row)
            matrix[std::size_t(row * 3 + column)] = values[std::size_t(row)];
    }
    const std::array<float, 3> probe{ 0.3f, 0.05f, 2.0f };
    const auto values = apply(cpu, probe);
    for (int row = 0; row < 3; ++row) {
        double sum = 0;
        for (int column = 0; column < 3; ++column)
            sum += matrix[std::size_t(row * 3 + column)] * double(probe[std::size_t(column)]);
        if (!(std::abs(sum - values[std::size_t(row)]) < 1e-4))
            fail("colour space '" + name + "' is not linear: no matrix takes it to the config's reference space");
    }
    return matrix;
}

std::vector<std::string> color_space_names(const OCIO::ConstConfigRcPtr& config)
{
    std::vector<std::string> names;
    for (int i = 0; i < config->getNumColorSpaces(); ++i)
        names.push_back(config->getColorSpaceNameByIndex(i));
    return names;
}

/// Linear sRGB → ACES2065-1, Bradford.
OCIO::ConstTransformRcPtr srgb_to_aces()
{
    double m44[16] = { 0 };
    for (int i = 0; i < 9; ++i)
        m44[i / 3 * 4 + i % 3] = double(kSrgbToXyz[std::size_t(i)]);
    m44[15] = 1;
    auto to_xyz = OCIO::MatrixTransform::Create();
    to_xyz->setMatrix(m44);
    auto to_aces = OCIO::BuiltinTransform::Create();
    to_aces->setStyle("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD");
    to_aces->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
    auto group = OCIO::GroupTransform::Create();
    group->appendTransform(to_xyz);
    group->appendTransform(to_aces);
    return group;
}

} // namespace

LinearSrgb find_linear_srgb(const OCIO::ConstConfigRcPtr& config, const std::string& name)
{
    auto extended = config->createEditableCopy();
    auto reference = OCIO::ColorSpace::Create(OCIO::REFERENCE_SPACE_SCENE); // no transform: the reference space itself
    reference->setName(kReference);
    extended->addColorSpace(reference);
    if (!name.empty()) {
        if (!config->getColorSpace(name.c_str()))
            fail("--linear-srgb: the config has no colour space '" + name + "'" +
                 near_names(name, color_space_names(config)));
        return { matrix_of(extended->getProcessor(name.c_str(), kReference), name), name };
    }
    for (const char* usual : kUsualNames)
        if (config->getColorSpace(usual))
            return { matrix_of(extended->getProcessor(usual, kReference), usual), usual };
    if (!config->hasRole(kInterchange))
        fail("the config has no colour space with one of the usual names of linear sRGB, and no role aces_interchange; "
             "say which one it is: --linear-srgb NAME");
    const auto from_aces = matrix_of(extended->getProcessor(kInterchange, kReference), kInterchange);
    const auto to_aces = matrix_of(config->getProcessor(srgb_to_aces()), kInterchange);
    LinearSrgb found{ {}, kInterchange };
    for (std::size_t i = 0; i < 9; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            found.to_reference[i] += from_aces[i / 3 * 3 + k] * to_aces[k * 3 + i % 3];
    return found;
}

} // namespace srisp::tool
