// SPDX-License-Identifier: Apache-2.0
#include "train/samples/sample_geometry.h"

namespace srisp::train {

namespace {

/// One half is the reference, a quarter of the whole in the other half the source. [method 5: half split]
void split_halves(SampleGeometry& geometry, bool upright, bool second_half, bool second_quarter)
{
    geometry.reference = { 0, 0, 0.5, 1 };
    geometry.source = { 0.5, 0, 1, 0.5 };
    if (second_quarter)
        geometry.source = { 0.5, 0.5, 1, 1 };
    for (Window* window : { &geometry.reference, &geometry.source }) {
        if (second_half)
            *window = { 1 - window->right, window->top, 1 - window->left, window->bottom };
        if (upright)
            *window = { window->top, window->left, window->bottom, window->right };
    }
}

int draw_detail(const DataSettings& settings, Random& random)
{
    const bool blurred = random.chance(settings.blurred);
    const int span = std::max(1, settings.image_size - settings.smallest_detail);
    const int detail = settings.smallest_detail + static_cast<int>(random.integer(span));
    return blurred && detail < settings.image_size ? detail : 0;
}

torch::Tensor oriented(const torch::Tensor& image, const SampleGeometry& geometry)
{
    const auto turned = torch::rot90(image, geometry.quarter_turns, { 1, 2 });
    return geometry.mirrored ? turned.flip(2) : turned;
}

} // namespace

Window draw_crop(const DataSettings& settings, Random& random)
{
    const double width = random.uniform(settings.smallest_crop, 1), height = random.uniform(settings.smallest_crop, 1);
    const double left = random.uniform(0, 1 - width), top = random.uniform(0, 1 - height);
    return { left, top, left + width, top + height };
}

SampleGeometry draw_geometry(const DataSettings& settings, Random random)
{
    SampleGeometry geometry;
    const double kind = random.uniform();
    const bool upright = random.chance(settings.upright_split), second_half = random.chance(0.5);
    const bool second_quarter = random.chance(0.5);
    geometry.source = draw_crop(settings, random);
    geometry.reference = draw_crop(settings, random);
    if (kind < settings.other_scene)
        geometry.kind = SampleGeometry::Reference::other_scene;
    else if (kind < settings.other_scene + settings.half_split) {
        geometry.kind = SampleGeometry::Reference::half_split;
        split_halves(geometry, upright, second_half, second_quarter);
    }
    geometry.source_detail = draw_detail(settings, random);
    geometry.reference_detail = draw_detail(settings, random);
    const int turns = static_cast<int>(random.integer(4));
    const bool mirrored = random.chance(0.5);
    geometry.quarter_turns = settings.rotate ? turns : 0;
    geometry.mirrored = settings.flip && mirrored;
    return geometry;
}

torch::Tensor cut(const torch::Tensor& scenes, const std::vector<SampleGeometry>& geometry,
                  Window SampleGeometry::*window, int SampleGeometry::*detail, int size)
{
    std::vector<Window> windows;
    for (const SampleGeometry& sample : geometry)
        windows.push_back(sample.*window);
    const auto crops = area_crop(scenes, windows, size, size);
    const auto result = torch::empty_like(crops);
    for (std::size_t n = 0; n < geometry.size(); ++n) {
        auto crop = crops[n];
        if (const int few = geometry[n].*detail)
            crop = area_resize(area_resize(crop.unsqueeze(0), few, few), size, size).squeeze(0);
        result[n].copy_(oriented(crop, geometry[n]));
    }
    return result;
}

} // namespace srisp::train
