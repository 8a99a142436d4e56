// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include <srisp/noise.h>

#include "base/guarded.h"
#include "base/parallel.h"
#include "base/shown_text.h"
#include "noise/noise_kernel.h"

namespace srisp {

namespace {

/// The variances of a row's pixels from an even x on: two kinds of rows.
struct RowVariances {
    std::vector<float> shot = std::vector<float>(kNoiseBuffer), read = shot;

    RowVariances(const NoiseModel& noise, BayerPhase phase, int y)
    {
        for (int x = 0; x < kNoiseBuffer; ++x) {
            const auto color = std::size_t(bayer_color(phase, x, y));
            shot[std::size_t(x)] = float(noise.shot[color]);
            read[std::size_t(x)] = float(noise.read[color]);
        }
    }
};

/// One row, block by block; false where a value is not finite: its block is left as it is.
bool add_row_noise(MutablePlaneView plane, int row, MosaicPlace place, const RowVariances& variances,
                   std::uint64_t seed)
{
    float values[kNoiseBuffer] = {};
    bool finite = true;
    const int last = place.x + plane.width;
    for (int start = place.x & ~3; start < last; start += kNoiseBlock) {
        const int from = std::max(start, place.x), to = std::min(start + kNoiseBlock, last);
        float* pixels = plane.pixel(from - place.x, row);
        std::fill(values, values + (from - start), 0.0f);
        for (int x = 0; x < to - from; ++x)
            values[from - start + x] = pixels[x * plane.x_stride];
        const NoiseBlock block{ seed, start, place.y + row, to - start, variances.shot.data(), variances.read.data() };
        if (!add_block_noise(block, values)) {
            finite = false;
            continue;
        }
        for (int x = 0; x < to - from; ++x)
            pixels[x * plane.x_stride] = values[from - start + x];
    }
    return finite;
}

Error not_finite(PlaneView plane, MosaicPlace place)
{
    for (int y = 0; y < plane.height; ++y)
        for (int x = 0; x < plane.width; ++x)
            if (const float value = *plane.pixel(x, y); !std::isfinite(value))
                return { "value " + shown_number(value) + " of pixel (" + std::to_string(place.x + x) + ", " +
                         std::to_string(place.y + y) + "): noise needs finite ones" };
    return { "a value is not finite" };
}

} // namespace

Status add_noise(MutablePlaneView plane, MosaicPlace place, const NoiseModel& noise, std::uint64_t seed, int threads)
{
    return guarded("noise", {}, [&]() -> Status {
        if (const Status possible = check_noise(noise); !possible)
            return possible;
        const RowVariances kinds[2] = { { noise, place.phase, 0 }, { noise, place.phase, 1 } };
        constexpr int kRows = 16; // of a task
        std::atomic<bool> finite{ true };
        parallel_tasks((plane.height + kRows - 1) / kRows, threads, [&](std::int64_t task) {
            const int first = int(task) * kRows, last = std::min(first + kRows, plane.height);
            for (int row = first; row < last; ++row)
                if (!add_row_noise(plane, row, place, kinds[(place.y + row) & 1], seed))
                    finite = false;
        });
        return finite ? Status() : Status(not_finite(plane, place));
    });
}

} // namespace srisp
