// SPDX-License-Identifier: Apache-2.0
#include "select/planar_thumbnail.h"

#include "thumbnail/area_squasher.h"

namespace srisp {

PlanarThumbnail::PlanarThumbnail(const Thumbnail& thumbnail, int size) : PlanarThumbnail(size)
{
    std::vector<float> smaller;
    if (size != kThumbnailSize) {
        AreaSquasher squasher(kThumbnailSize, kThumbnailSize, size);
        squasher.add_rows(thumbnail.view());
        constexpr int kUpright = 1;
        smaller = squasher.finish(kUpright);
    }
    split_channels(smaller.empty() ? thumbnail.rgb.data() : smaller.data(), planes(), count());
}

void add_to_input(EncoderInput& input, int first_channel, const PlanarThumbnail& image, Scale scale, bool perceptual)
{
    PlanarThumbnail scaled;
    const PlanarThumbnail* values = &image;
    if (perceptual && scale == Scale::linear) {
        scaled = PlanarThumbnail(image.size());
        power(image.planes(), scaled.planes(), image.count(), 1 / 2.2f, 1e-5f, -0.3f);
        values = &scaled;
    }
    const float offset = perceptual && scale == Scale::display ? 0.4f : 0.0f;
    const Planes from = values->planes();
    const int size = image.size(), channels = input.channels();
    for (int y = 0; y < size; ++y) {
        const std::ptrdiff_t begin = std::ptrdiff_t(y) * size;
        const float *const r = from.plane(0) + begin, *const g = from.plane(1) + begin,
                           *const b = from.plane(2) + begin;
        float* to = input.row(y) + first_channel;
        for (int x = 0; x < size; ++x, to += channels) {
            to[0] = r[x] - offset;
            to[1] = g[x] - offset;
            to[2] = b[x] - offset;
        }
    }
}

EncoderInput encoder_input(const PlanarThumbnail& image, Scale scale, bool perceptual)
{
    EncoderInput input(3, image.size());
    add_to_input(input, 0, image, scale, perceptual);
    return input;
}

} // namespace srisp
