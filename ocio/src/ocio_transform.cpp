// SPDX-License-Identifier: Apache-2.0
#include <srisp/ocio_transform.h>

#include <algorithm>

#include <srisp/apply.h>
#include <srisp/model.h>

#include "base/guarded.h"
#include "base/matrix3.h"
#include "model/model_data.h"
#include "operators.h"

namespace srisp {

namespace OCIO = OCIO_NAMESPACE;

namespace {

constexpr float kGammaFloor = 1e-8f; // below it, v^(1/γ) is that of the floor [method 1]

Expected<Cube> tone_cube(const Model& model, const Parameters& parameters, Direction direction, int size)
{
    Cube cube{ size, {} };
    cube.rgb.reserve(std::size_t(3) * size * size * size);
    for (int r = 0; r < size; ++r)
        for (int g = 0; g < size; ++g)
            for (int b = 0; b < size; ++b)
                for (const int i : { r, g, b })
                    cube.rgb.push_back(static_cast<float>(i) / static_cast<float>(size - 1));
    if (Status status = tone_map_values(model, parameters, direction, cube.rgb.data(),
                                        std::int64_t(cube.rgb.size() / 3), cube.rgb.data());
        !status)
        return status.error();
    return cube;
}

Affine affine(const Matrix3& matrix)
{
    Affine result{};
    std::copy(matrix.begin(), matrix.end(), result.matrix.begin());
    return result;
}

Operators reverse_operators(const Parameters& p, Cube tone)
{
    Operators operators{ Clamp{ 0, 1 },    std::move(tone),          Clamp{ kGammaFloor, 1 },
                         Power{ p.gamma }, affine(inverse(p.color)), Clamp{ 0, 1 } };
    std::array<float, 3> most{ 1, 1, 1 };
    append_inverse_gain(operators, { 1 / p.white_balance[0], 1 / p.white_balance[1], 1 / p.white_balance[2] }, most);
    append_inverse_gain(operators, { 1 / p.gain, 1 / p.gain, 1 / p.gain }, most);
    operators.push_back(Clamp{ 0, 1 });
    return operators;
}

Operators forward_operators(const Parameters& p, Cube tone, bool rebuilds_highlights)
{
    const Affine balance = diagonal(p.white_balance[0], p.white_balance[1], p.white_balance[2]);
    Operators operators{ Clamp{ 0, 1 } };
    if (rebuilds_highlights) {
        operators.push_back(balance);
        append_rebuilt_highlights(operators, p.gain, *std::max_element(p.white_balance.begin(), p.white_balance.end()));
    } else {
        operators.insert(operators.end(), { diagonal(p.gain, p.gain, p.gain), Clamp{ 0, 1 }, balance, Clamp{ 0, 1 } });
    }
    operators.insert(operators.end(), { affine(p.color), Clamp{ kGammaFloor, 1 }, Power{ 1 / p.gamma } });
    operators.push_back(std::move(tone));
    operators.push_back(Clamp{ 0, 1 });
    return operators;
}

Status check_bakeable(const Development& development)
{
    if (development.highlights != Highlights::blend)
        return {};
    return Error{ "highlights that are blended have no OpenColorIO transform: clip or keep" };
}

} // namespace

Operators development_operators(const Development& development)
{
    const auto& [red, green, blue] = development.multipliers;
    Operators operators{ diagonal(red, green, blue) };
    if (development.highlights == Highlights::clip)
        operators.push_back(Limit{ development.white });
    operators.push_back(affine(development.matrix));
    return operators;
}

Expected<Operators> pipeline_operators(const Model& model, const Parameters& parameters, Direction direction,
                                       int lut_size)
{
    if (lut_size < kSmallestLut || lut_size > kLargestLut)
        return Error{ "LUT size " + std::to_string(lut_size) + " must be within " + std::to_string(kSmallestLut) +
                      " … " + std::to_string(kLargestLut) };
    auto tone = tone_cube(model, parameters, direction, lut_size);
    if (!tone)
        return tone.error();
    return direction == Direction::reverse ? reverse_operators(parameters, std::move(*tone))
                                           : forward_operators(parameters, std::move(*tone),
                                                               model_data(model).rebuilds_highlights(parameters.gain));
}

Expected<OCIO::GroupTransformRcPtr> make_ocio_transform(const Model& model, const Parameters& parameters,
                                                        Direction direction, int lut_size)
{
    return guarded("OpenColorIO transform", {}, [&]() -> Expected<OCIO::GroupTransformRcPtr> {
        const auto operators = pipeline_operators(model, parameters, direction, lut_size);
        if (!operators)
            return operators.error();
        return ocio_group(*operators);
    });
}

Expected<std::string> make_clf(const Model& model, const Parameters& parameters, Direction direction,
                               const ClfLabel& label, int lut_size)
{
    return guarded("CLF", {}, [&]() -> Expected<std::string> {
        const auto operators = pipeline_operators(model, parameters, direction, lut_size);
        if (!operators)
            return operators.error();
        return clf_text(*operators, label);
    });
}

Expected<OCIO::GroupTransformRcPtr> make_ocio_development(const Development& development)
{
    return guarded("OpenColorIO transform", {}, [&]() -> Expected<OCIO::GroupTransformRcPtr> {
        const Status bakeable = check_bakeable(development);
        return bakeable ? Expected<OCIO::GroupTransformRcPtr>(ocio_group(development_operators(development)))
                        : bakeable.error();
    });
}

Expected<std::string> make_development_clf(const Development& development, const ClfLabel& label)
{
    return guarded("CLF", {}, [&]() -> Expected<std::string> {
        const Status bakeable = check_bakeable(development);
        return bakeable ? Expected<std::string>(clf_text(development_operators(development), label)) : bakeable.error();
    });
}

} // namespace srisp
