// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <srisp/mosaic.h>

#include "base/guarded.h"
#include "base/parallel.h"

namespace srisp {

namespace {

std::string size_text(int width, int height)
{
    return std::to_string(width) + " x " + std::to_string(height);
}

/// Each second pixel of a row, from its first one or second one on.
void copy_every_second(const float* source, std::ptrdiff_t source_stride, float* target, std::ptrdiff_t target_stride,
                       int count)
{
    for (int i = 0; i < count; ++i)
        target[i * target_stride] = source[i * source_stride];
}

} // namespace

Status make_mosaic(ImageView image, MosaicPlace place, MutablePlaneView target, int threads)
{
    return guarded("mosaic", {}, [&]() -> Status {
        if (target.width != image.width || target.height != image.height)
            return Error{ "a mosaic of " + size_text(target.width, target.height) + " pixels cannot be made of " +
                          size_text(image.width, image.height) };
        constexpr int kRows = 32; // of a task
        const BayerPhase phase = place.phase_here();
        parallel_tasks((image.height + kRows - 1) / kRows, threads, [&](std::int64_t task) {
            const int first = int(task) * kRows, last = std::min(first + kRows, image.height);
            for (int y = first; y < last; ++y)
                for (int x = 0; x < std::min(2, image.width); ++x)
                    copy_every_second(image.pixel(x, y) + bayer_color(phase, x, y), 2 * image.x_stride,
                                      target.pixel(x, y), 2 * target.x_stride, (image.width - x + 1) / 2);
        });
        return {};
    });
}

} // namespace srisp
