// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <optional>

#include "apply/job.h"
#include "kernels/pixel_pipeline.h"

namespace srisp {

/// The pipeline of a pointwise model: pixel by pixel, in the order in which they lie in memory.
class PointwisePipeline : public Pipeline {
public:
    PointwisePipeline(Direction direction, PixelPipeline pixels, Precision precision)
        : m_direction(direction), m_pixels(std::move(pixels)), m_precision(precision)
    {
    }

    int halo() const override { return 0; }
    void run(const Job& job, int threads, Progress& progress) const override;

private:
    /// Null where the image is too small to be worth a table.
    const ToneTable* table_for(const ImagePart& image, int threads) const;
    void run_pixels(const ToneTable* table, const float* in, std::ptrdiff_t in_stride, float* out,
                    std::ptrdiff_t out_stride, std::int64_t count) const;

    Direction m_direction;
    PixelPipeline m_pixels;
    Precision m_precision;
    mutable std::once_flag m_table_made;
    mutable std::optional<ToneTable> m_table; ///< made for the first image that is worth it
};

} // namespace srisp
