// SPDX-License-Identifier: Apache-2.0
#include "apply/pointwise_pipeline.h"

#include <algorithm>

#include "base/parallel.h"

namespace srisp {

namespace {

// What a thread takes at a time: a third of a millisecond.
constexpr std::int64_t kPixelsAtATime = 4800;

/// Lines of pixels: a part of a row each, or of all rows where they follow each other without gaps.
class PixelLines {
public:
    explicit PixelLines(const Job& job) : m_job(job), m_width(job.target.width), m_height(job.target.height)
    {
        if (follow_each_other(job.source.pixels) && follow_each_other(job.target)) {
            m_width *= m_height;
            m_height = 1;
        }
        m_per_row = (m_width + kPixelsAtATime - 1) / kPixelsAtATime;
    }

    std::int64_t count() const { return m_per_row * m_height; }
    /// Lines that are about as much work as a long one.
    std::int64_t at_a_time() const { return std::max<std::int64_t>(1, kPixelsAtATime / m_width); }

    std::int64_t pixels(std::int64_t line) const { return std::min(kPixelsAtATime, m_width - column(line)); }
    const float* source(std::int64_t line) const
    {
        const ImageView& view = m_job.source.pixels;
        return m_job.first_source_pixel() + column(line) * view.x_stride + row(line) * view.y_stride;
    }
    float* target(std::int64_t line) const
    {
        return m_job.target.data + column(line) * m_job.target.x_stride + row(line) * m_job.target.y_stride;
    }

private:
    template<class View> bool follow_each_other(const View& view) const
    {
        return m_height == 1 || view.y_stride == m_width * view.x_stride;
    }
    std::int64_t row(std::int64_t line) const { return line / m_per_row; }
    std::int64_t column(std::int64_t line) const { return line % m_per_row * kPixelsAtATime; }

    const Job& m_job;
    std::int64_t m_width, m_height, m_per_row;
};

/// The first three channels of `count` pixels.
void copy_rgb(const float* in, std::ptrdiff_t in_stride, float* out, std::ptrdiff_t out_stride, std::int64_t count)
{
    for (std::int64_t x = 0; x < count; ++x, in += in_stride, out += out_stride)
        std::copy_n(in, 3, out);
}

} // namespace

const ToneTable* PointwisePipeline::table_for(const ImagePart& image, int threads) const
{
    // Of so many pixels, making a table and looking them up takes less time than computing them. It is the whole image
    // that counts, so that all its regions have the same bits.
    constexpr std::int64_t pixels_worth_it = 2 * ToneTable::kPoints;
    if (m_precision != Precision::fast || std::int64_t(image.full_width) * image.full_height < pixels_worth_it)
        return nullptr;
    std::call_once(m_table_made, [&] {
        ToneTable table;
        parallel_tasks(ToneTable::kSide, threads,
                       [&](std::int64_t red) { table.fill_plane(m_pixels.tone_map, static_cast<int>(red)); });
        m_table = std::move(table);
    });
    return &*m_table;
}

void PointwisePipeline::run_pixels(const ToneTable* table, const float* in, std::ptrdiff_t in_stride, float* out,
                                   std::ptrdiff_t out_stride, std::int64_t count) const
{
    const auto run = m_direction == Direction::reverse ? reverse_pixels : forward_pixels;
    if (in_stride == 3 && out_stride == 3)
        return run(m_pixels, table, in, out, count);
    float rgb[3 * 480];
    for (std::int64_t x = 0, part; x < count; x += part) {
        part = std::min<std::int64_t>(480, count - x);
        copy_rgb(in + x * in_stride, in_stride, rgb, 3, part);
        run(m_pixels, table, rgb, rgb, part);
        copy_rgb(rgb, 3, out + x * out_stride, out_stride, part);
    }
}

void PointwisePipeline::run(const Job& job, int threads, Progress& progress) const
{
    const ToneTable* const table = table_for(job.source, threads);
    const PixelLines lines(job);
    const std::int64_t at_a_time = lines.at_a_time(), tasks = (lines.count() + at_a_time - 1) / at_a_time;
    parallel_tasks(tasks, threads, [&](std::int64_t task) {
        if (progress.cancelled())
            return;
        std::int64_t done = 0;
        for (std::int64_t line = task * at_a_time; line < std::min((task + 1) * at_a_time, lines.count()); ++line) {
            const std::int64_t count = lines.pixels(line);
            run_pixels(table, lines.source(line), job.source.pixels.x_stride, lines.target(line), job.target.x_stride,
                       count);
            done += count;
        }
        progress.add(done);
    });
}

} // namespace srisp
