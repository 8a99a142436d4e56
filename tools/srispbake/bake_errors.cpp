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

/// The pipeline of one model in one direction.
class Renderer {
public:
    Renderer(const Chosen& chosen, Direction direction)
        : m_applier(require(Applier::create(*chosen.model, chosen.parameters, direction)))
    {
    }

    /// `rgb` is the part `held` of an image of width × height; the result is `roi` of it.
    Pixels operator()(const Pixels& rgb, Roi held, int width, int height, Roi roi) const
    {
        const int held_width = held.x1 - held.x0, roi_width = roi.x1 - roi.x0;
        Pixels result(std::size_t(3) * roi_width * (roi.y1 - roi.y0));
        require(m_applier->run(
            { ImageView{ rgb.data(), held_width, held.y1 - held.y0, 3, std::ptrdiff_t(3) * held_width }, held.x0,
              held.y0, width, height },
            roi, MutableImageView{ result.data(), roi_width, roi.y1 - roi.y0, 3, std::ptrdiff_t(3) * roi_width }));
        return result;
    }
    /// Single colours.
    Pixels operator()(const Pixels& rgb) const
    {
        const Roi all{ 0, int(rgb.size() / 3), 0, 1 };
        return (*this)(rgb, all, all.x1, 1, all);
    }

private:
    std::shared_ptr<const Applier> m_applier;
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

/// `roi` and as much of `halo` around it as `held` has.
Roi grown(Roi roi, Roi held, int halo)
{
    return { std::max(roi.x0 - halo, held.x0), std::min(roi.x1 + halo, held.x1), std::max(roi.y0 - halo, held.y0),
             std::min(roi.y1 + halo, held.y1) };
}

/// What a pipeline makes of one part of the photo. Forward: of its own RAW-like image of it.
Pixels rendered(const Chosen& chosen, const PhotoSample& photo, const PhotoSample::Tile& tile, Direction direction)
{
    const Renderer reverse(chosen, Direction::reverse);
    if (direction == Direction::reverse)
        return reverse(tile.rgb, tile.held, photo.width, photo.height, tile.roi);
    const Roi around = grown(tile.roi, tile.held, PhotoSample::kHalo / 2);
    const Pixels raw = reverse(tile.rgb, tile.held, photo.width, photo.height, around);
    return Renderer(chosen, Direction::forward)(raw, around, photo.width, photo.height, tile.roi);
}

/// The pixels of the part alone.
Pixels cut_out(const PhotoSample::Tile& tile)
{
    Pixels rgb;
    const std::ptrdiff_t row = std::ptrdiff_t(3) * (tile.held.x1 - tile.held.x0);
    for (int y = tile.roi.y0; y < tile.roi.y1; ++y) {
        const float* first = tile.rgb.data() + (y - tile.held.y0) * row + 3 * (tile.roi.x0 - tile.held.x0);
        rgb.insert(rgb.end(), first, first + std::ptrdiff_t(3) * (tile.roi.x1 - tile.roi.x0));
    }
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

BakeErrors measure_errors(const OCIO::ConstTransformRcPtr& transform, const BakeChoice& choice, Direction direction)
{
    const Bake bake(transform);
    const Renderer pointwise(choice.pointwise, direction), reverse(choice.pointwise, Direction::reverse);
    BakeErrors errors;
    const Pixels grid = dense_grid();
    errors.grid.add(bake(grid), pointwise(grid));
    if (!choice.photo)
        return errors;
    errors.photo.emplace();
    if (choice.full)
        errors.full.emplace();
    for (const PhotoSample::Tile& tile : choice.photo->tiles) {
        check_interrupt();
        const Pixels photo = cut_out(tile);
        const Pixels in = direction == Direction::reverse ? photo : reverse(photo);
        const Pixels baked = bake(in);
        errors.photo->add(baked, pointwise(in));
        if (choice.full)
            errors.full->add(baked, rendered(*choice.full, *choice.photo, tile, direction));
    }
    return errors;
}

} // namespace srisp::tool
