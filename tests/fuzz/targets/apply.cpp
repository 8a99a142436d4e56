// SPDX-License-Identifier: Apache-2.0
// Applying parameters: odd shapes, strides, values and regions, held against the whole image.
#include <srisp/apply.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include <srisp/model.h>

#include "fuzz_target.h"
#include "random_model.h"

using namespace srisp;

namespace {

std::shared_ptr<const Model> made_model(int kernel_size)
{
    const ScratchFolder scratch;
    const auto model = Model::load(random_model(kernel_size, 1).write(scratch.path("random.safetensors")));
    fuzz::must_hold(bool(model), "the model can be loaded");
    return *model;
}

Parameters drawn_parameters(const Model& model, fuzz::Draws& draws)
{
    Parameters parameters;
    parameters.model_hash = model.hash();
    for (auto& weights : parameters.tone_weights)
        for (int i = 0; i < model.dictionary_size(); ++i)
            weights.push_back(draws.within(0, 0.4f));
    parameters.gamma = draws.odd_float(1, 3);
    parameters.gain = draws.odd_float(0.5f, 2);
    for (float& value : parameters.white_balance)
        value = draws.odd_float(0.5f, 3);
    for (std::size_t i = 0; i < 9; ++i)
        parameters.color[i] = draws.odd_float(-0.4f, 0.4f) + (i % 4 == 0 ? 1 : 0);
    return parameters;
}

/// Pixels in an allocation that ends with the last one's last value.
struct Pixels {
    int width, height, x_stride;
    std::ptrdiff_t y_stride;
    std::vector<float> values;

    Pixels(int w, int h, int stride, int gap)
        : width(w), height(h), x_stride(stride), y_stride(std::ptrdiff_t(stride) * w + gap),
          values(std::size_t(y_stride * (h - 1) + std::ptrdiff_t(stride) * (w - 1) + 3))
    {
        values.shrink_to_fit();
    }
    MutableImageView view() { return { values.data(), width, height, x_stride, y_stride }; }
};

bool same_bits(float a, float b)
{
    return a == b || (std::isnan(a) && std::isnan(b));
}

/// The region, from a source that holds no more than it needs, in pieces of their own and in place.
void check_region(const Applier& applier, Pixels& source, Pixels& whole, fuzz::Draws& draws)
{
    Roi roi{ draws.below(source.width), 0, draws.below(source.height), 0 };
    roi.x1 = roi.x0 + 1 + draws.below(source.width - roi.x0);
    roi.y1 = roi.y0 + 1 + draws.below(source.height - roi.y0);
    const int halo = applier.halo();
    const int x0 = std::max(roi.x0 - halo, 0), y0 = std::max(roi.y0 - halo, 0);
    const int x1 = std::min(roi.x1 + halo, source.width), y1 = std::min(roi.y1 + halo, source.height);
    Pixels part(x1 - x0, y1 - y0, 3 + draws.below(2), draws.below(3));
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x)
            std::copy_n(source.view().pixel(x0 + x, y0 + y), 3, part.view().pixel(x, y));
    Pixels target(roi.x1 - roi.x0, roi.y1 - roi.y0, 3 + draws.below(2), draws.below(3));
    const bool in_place = draws.flag() && part.width >= target.width && part.height >= target.height;
    MutableImageView out = target.view();
    if (in_place)
        out = { part.view().pixel(roi.x0 - x0, roi.y0 - y0), target.width, target.height, part.x_stride,
                part.y_stride };
    ApplyOptions options;
    options.threads = 1 + draws.below(2);
    const Status status = applier.run(ImagePart{ part.view(), x0, y0, source.width, source.height }, roi, out, options);
    fuzz::must_hold(bool(status), "a region is computed", status.error().message);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x)
            for (int c = 0; c < 3; ++c)
                fuzz::must_hold(same_bits(out.pixel(x, y)[c], whole.view().pixel(roi.x0 + x, roi.y0 + y)[c]),
                                "a region has the bits of the whole image");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const std::shared_ptr<const Model> kModels[] = { made_model(1), made_model(3) };
    fuzz::Draws draws(data, size);
    const Model& model = *kModels[draws.below(2)];
    const Parameters parameters = drawn_parameters(model, draws);
    const auto applier = Applier::create(model, parameters, draws.flag() ? Direction::forward : Direction::reverse,
                                         draws.flag() ? Precision::fast : Precision::float32);
    if (!fuzz::is_accepted(applier))
        return 0;
    Pixels source(1 + draws.below(80), 1 + draws.below(24), 3 + draws.below(2), draws.below(3));
    bool odd = false;
    for (float& value : source.values) {
        value = draws.odd_float(0, 1);
        odd |= !(value >= 0 && value <= 1);
    }
    Pixels whole(source.width, source.height, 3, 0);
    const Status status = (*applier)->run(source.view(), whole.view(), {});
    fuzz::must_hold(bool(status), "an image is computed", status.error().message);
    if (!odd)
        fuzz::must_be_in_unit_range(whole.values, "results are in [0,1]");
    check_region(**applier, source, whole, draws);
    return 0;
}
