// SPDX-License-Identifier: Apache-2.0
#include "bake_errors.h"

#include <cmath>

#include "../common/failure.h"
#include "../common/interrupt.h"

namespace srisp::tool {

namespace OCIO = OCIO_NAMESPACE;

namespace {

constexpr int kGridSide = 48; // 47 shares no factor with the usual sizes of LUTs: colours lie between their points

using Pixels = std::vector<float>;

/// The library's pixels.
class Renderer {
public:
    Renderer(const BakeChoice& choice, BakeKind kind) : m_development(choice.development)
    {
        if (kind != BakeKind::develop)
            m_applier = require(Applier::create(*choice.model, choice.parameters,
                                                kind == BakeKind::process ? Direction::forward : Direction::reverse));
    }
    Pixels operator()(Pixels rgb) const
    {
        const int width = int(rgb.size() / 3);
        const MutableImageView colors{ rgb.data(), width, 1, 3, std::ptrdiff_t(3) * width };
        require(m_applier ? m_applier->run(colors, colors) : develop(m_development, colors, colors));
        return rgb;
    }

private:
    const Development& m_development;
    std::shared_ptr<const Applier> m_applier; ///< null: it is developed
};

/// The bake as a host applies it.
class Bake {
public:
    explicit Bake(const OCIO::ConstTransformRcPtr& transform)
        : m_processor(OCIO::Config::CreateRaw()->getProcessor(transform)->getDefaultCPUProcessor())
    {
    }
    Pixels operator()(Pixels rgb) const
    {
        OCIO::PackedImageDesc image(rgb.data(), long(rgb.size() / 3), 1, 3);
        m_processor->apply(image);
        return rgb;
    }

private:
    OCIO::ConstCPUProcessorRcPtr m_processor;
};

Pixels dense_grid()
{
    Pixels rgb;
    for (int r = 0; r < kGridSide; ++r)
        for (int g = 0; g < kGridSide; ++g)
            for (int b = 0; b < kGridSide; ++b)
                for (const int i : { r, g, b })
                    rgb.push_back(float(i) / float(kGridSide - 1));
    return rgb;
}

} // namespace

void ErrorSize::add(const std::vector<float>& a, const std::vector<float>& b)
{
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double difference = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
        largest = std::max(largest, difference);
        sum += difference;
    }
    values += static_cast<std::int64_t>(a.size());
}

BakeErrors measure_errors(const OCIO::ConstTransformRcPtr& transform, const BakeChoice& choice, BakeKind kind)
{
    const Bake bake(transform);
    const Renderer library(choice, kind), reverse(choice, BakeKind::unprocess);
    BakeErrors errors;
    const Pixels grid = dense_grid();
    errors.grid.add(bake(grid), library(grid));
    if (!choice.photo)
        return errors;
    errors.photo.emplace();
    for (const PhotoSample::Tile& tile : choice.photo->tiles) {
        check_interrupt();
        const Pixels in = kind == BakeKind::unprocess ? tile.rgb : reverse(tile.rgb);
        errors.photo->add(bake(in), library(in));
    }
    return errors;
}

} // namespace srisp::tool
