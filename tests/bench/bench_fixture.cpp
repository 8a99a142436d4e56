// SPDX-License-Identifier: Apache-2.0
#include "bench_fixture.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

#include <srisp/reference.h>

#include "measuring.h"
#include "require.h"

using namespace srisp;

static Picture synthetic(int width, int height)
{
    Picture picture(width, height);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i)
        picture.rgb[i] = static_cast<float>((i / 3 * 2654435761u % 1000 + i % 4096) / 5095.0);
    return picture;
}

Picture bench_picture(const BenchSettings& settings, int width, int height)
{
    if (settings.photo.empty())
        return synthetic(width, height);
    const Picture photo = load_photo(settings.photo);
    Picture picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            std::copy_n(photo.view().pixel(x % photo.width, y % photo.height), 3, picture.mutable_view().pixel(x, y));
    return picture;
}

BenchFixture::BenchFixture(const BenchSettings& settings) : model(require(Model::load(settings.model)))
{
    source = make_thumbnail(
        (settings.photo.empty() ? synthetic(kThumbnailSize, kThumbnailSize) : load_photo(settings.photo)).view());
    if (settings.reference.empty()) {
        Picture raw = synthetic(kThumbnailSize, kThumbnailSize);
        std::transform(raw.rgb.begin(), raw.rgb.end(), raw.rgb.begin(), [](float v) { return v * v * 0.5f; });
        reference = make_thumbnail(raw.view());
    } else
        reference = require(load_reference(settings.reference))->thumbnail;
    parameters = require(select(*model, source, reference));
}

std::shared_ptr<const Applier> BenchFixture::applier(Precision precision) const
{
    return require(Applier::create(*model, parameters, Direction::reverse, precision));
}

double apply_seconds(const Applier& applier, Picture& picture, int threads)
{
    ApplyOptions options;
    options.threads = threads;
    return seconds([&] { require(applier.run(picture.view(), picture.mutable_view(), options)); });
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

std::string digits(double value, int after_point)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", after_point, value);
    return text;
}
