// SPDX-License-Identifier: Apache-2.0
#include <srisp/apply.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include <OpenImageIO/imageio.h>
#include <srisp/model.h>

#include "apply/tone_map.h"
#include "base/guarded.h"
#include "base/parallel.h"
#include "model/model_data.h"

namespace srisp {

namespace {

/// The pipeline's blocks in one direction, ready to run.
struct Pipeline {
    std::unique_ptr<const ToneMap> tone_map;
    Direction direction;
    Matrix3 color;                   // C (forward) or its inverse (reverse)
    float exponent;                  // 1/γ (forward) or γ (reverse)
    float white_balance[3], gain[3]; // multipliers (forward) or scales 1/g (reverse)
    bool rebuilds_highlights;        // forward
};

constexpr int kMinTileRows = 16;
// Rows that are copied at a time where the target is the source: enough for tall tiles, and of wide images some 64 MB.
constexpr int kMinBandRows = 128, kMaxBandRows = 512;
constexpr std::ptrdiff_t kBandBytes = std::ptrdiff_t(64) << 20;

/// What is to be computed, and from what.
struct Job {
    ImagePart source;
    Roi roi;
    MutableImageView target;
};

/// The region cut into tiles: as few columns as the tone map's memory allows, all about equally wide.
class TileGrid {
public:
    TileGrid(Roi roi, const ToneMap& tone_map, int threads) : m_roi(roi)
    {
        const int width = roi.x1 - roi.x0, height = roi.y1 - roi.y0;
        m_columns = (width + tone_map.max_tile_width() - 1) / tone_map.max_tile_width();
        m_tile_width = (width + m_columns - 1) / m_columns;
        // Enough tiles to keep all threads busy to the end.
        const int rows_wanted = (4 * threads + m_columns - 1) / m_columns;
        m_tile_height = std::clamp((height + rows_wanted - 1) / rows_wanted, kMinTileRows, tone_map.good_tile_height());
        m_rows = (height + m_tile_height - 1) / m_tile_height;
    }

    int count() const { return m_rows * m_columns; }
    Roi tile(int index) const
    {
        const int x0 = m_roi.x0 + index % m_columns * m_tile_width, y0 = m_roi.y0 + index / m_columns * m_tile_height;
        return { x0, std::min(x0 + m_tile_width, m_roi.x1), y0, std::min(y0 + m_tile_height, m_roi.y1) };
    }

private:
    Roi m_roi;
    int m_columns, m_rows, m_tile_width, m_tile_height;
};

void gather(const float* pixel, std::ptrdiff_t x_stride, int count, Planes row)
{
    if (x_stride == 3)
        return split_channels(pixel, row, count);
    for (int x = 0; x < count; ++x, pixel += x_stride)
        for (int c = 0; c < 3; ++c)
            row.plane(c)[x] = pixel[c];
}

void scatter(Planes row, int count, float* pixel, std::ptrdiff_t x_stride)
{
    if (x_stride == 3)
        return join_channels(row, pixel, count);
    for (int x = 0; x < count; ++x, pixel += x_stride)
        for (int c = 0; c < 3; ++c)
            pixel[c] = row.plane(c)[x];
}

/// The first three channels of a row of pixels, without gaps.
void copy_rgb(const float* pixel, std::ptrdiff_t x_stride, int count, float* out)
{
    if (x_stride == 3) {
        std::copy_n(pixel, 3 * count, out);
        return;
    }
    for (int x = 0; x < count; ++x, pixel += x_stride)
        std::copy_n(pixel, 3, out + 3 * x);
}

/// What follows the tone map in the reverse pass.
void after_tone_map(const Pipeline& p, Planes row, std::size_t count)
{
    power(row, row, count, p.exponent, 1e-8f, 0);
    color_transform(row, row, count, p.color);
    inverse_gain(row, row, count, p.white_balance);
    inverse_gain(row, row, count, p.gain);
    clamp01(row, row, count);
}

/// What comes before the tone map in the forward pass.
void before_tone_map(const Pipeline& p, Planes row, std::size_t count)
{
    if (p.rebuilds_highlights) {
        rebuild_highlights(row, row, count, p.white_balance, p.gain[0]);
    } else {
        multiply(row, row, count, p.gain);
        multiply(row, row, count, p.white_balance);
    }
    color_transform(row, row, count, p.color);
    power(row, row, count, p.exponent, 1e-8f, 0);
}

void run_tile(const Pipeline& p, ToneMapRunner& runner, const Job& job, Roi tile)
{
    const auto load = [&](int y, int x0, int x1, Planes row) {
        const ImagePart& source = job.source;
        gather(source.pixels.pixel(x0 - source.x, y - source.y), source.pixels.x_stride, x1 - x0, row);
        if (p.direction == Direction::forward)
            before_tone_map(p, row, x1 - x0);
    };
    const auto store = [&](int y, Planes row) {
        if (p.direction == Direction::reverse)
            after_tone_map(p, row, tile.x1 - tile.x0);
        scatter(row, tile.x1 - tile.x0, job.target.pixel(tile.x0 - job.roi.x0, y - job.roi.y0), job.target.x_stride);
    };
    runner.run(tile, job.source.full_width, job.source.full_height, load, store);
}

/// How much of several jobs is done; asks the caller's progress function from the caller's thread only.
class Progress {
public:
    Progress(const ApplyOptions& options, std::int64_t rows_of_pixels)
        : m_callback(options.progress), m_total(rows_of_pixels), m_thread(std::this_thread::get_id())
    {
    }

    bool cancelled() const { return m_cancelled; }
    void add(std::int64_t pixels)
    {
        const std::int64_t done = m_done += pixels;
        if (m_callback && std::this_thread::get_id() == m_thread && !m_callback(float(done) / m_total))
            m_cancelled = true;
    }

private:
    const std::function<bool(float)>& m_callback;
    std::int64_t m_total;
    std::thread::id m_thread;
    std::atomic<std::int64_t> m_done{ 0 };
    std::atomic<bool> m_cancelled{ false };
};

/// Each worker takes the next tile until none is left, so a slow core holds nobody up.
void run_tiles(const Pipeline& p, const Job& job, int threads, Progress& progress)
{
    const TileGrid grid(job.roi, *p.tone_map, threads);
    std::atomic<int> next{ 0 };
    const auto work = [&](std::int64_t) {
        const std::unique_ptr<ToneMapRunner> runner = p.tone_map->make_runner();
        for (int i = next++; i < grid.count() && !progress.cancelled(); i = next++) {
            const Roi tile = grid.tile(i);
            run_tile(p, *runner, job, tile);
            progress.add(std::int64_t(tile.x1 - tile.x0) * (tile.y1 - tile.y0));
        }
    };
    const int workers = std::min(threads, grid.count());
    parallel_tasks(workers, workers, work);
}

/// Where source and target share memory: band by band from a copy, whose upper neighbours were copied before the band
/// above was overwritten.
void run_in_place(const Pipeline& p, const Job& job, int threads, Progress& progress)
{
    const int halo = p.tone_map->halo();
    const ImageView& pixels = job.source.pixels;
    const int first_row = std::max(job.roi.y0 - halo, 0);
    const int last_row = std::min(job.roi.y1 + halo, job.source.full_height);
    const std::ptrdiff_t row_floats = std::ptrdiff_t(3) * pixels.width;
    const std::ptrdiff_t rows_that_fit = kBandBytes / (row_floats * std::ptrdiff_t(sizeof(float)));
    const int band_rows = static_cast<int>(std::clamp<std::ptrdiff_t>(rows_that_fit, kMinBandRows, kMaxBandRows));
    std::vector<float> copy;
    copy.reserve((std::min(band_rows, last_row - first_row) + 2 * halo) * row_floats);
    int copied_from = first_row, copied_to = first_row;
    for (int y0 = job.roi.y0; y0 < job.roi.y1 && !progress.cancelled(); y0 += band_rows) {
        const int y1 = std::min(y0 + band_rows, job.roi.y1);
        const int from = std::max(y0 - halo, first_row), to = std::min(y1 + halo, last_row);
        copy.erase(copy.begin(), copy.begin() + (from - copied_from) * row_floats);
        copy.resize((to - from) * row_floats);
        parallel_tasks(to - copied_to, threads, [&](std::int64_t row) {
            const int y = copied_to + static_cast<int>(row);
            copy_rgb(pixels.pixel(0, y - job.source.y), pixels.x_stride, pixels.width, &copy[(y - from) * row_floats]);
        });
        copied_from = from;
        copied_to = to;

        Job band = job;
        band.source.pixels = { copy.data(), pixels.width, to - from, 3, row_floats };
        band.source.y = from;
        band.roi.y0 = y0;
        band.roi.y1 = y1;
        band.target.data = job.target.pixel(0, y0 - job.roi.y0);
        band.target.height = y1 - y0;
        run_tiles(p, band, threads, progress);
    }
}

bool share_memory(ImageView a, ImageView b)
{
    const auto end = [](ImageView v) { return v.pixel(v.width - 1, v.height - 1) + 3; };
    return std::less<>()(a.data, end(b)) && std::less<>()(b.data, end(a));
}

std::string size_text(int width, int height)
{
    return std::to_string(width) + " × " + std::to_string(height);
}

Status check_job(const Job& job, int halo)
{
    const Roi& roi = job.roi;
    const ImagePart& source = job.source;
    if (roi.x0 < 0 || roi.y0 < 0 || roi.x1 > source.full_width || roi.y1 > source.full_height || roi.x0 >= roi.x1 ||
        roi.y0 >= roi.y1)
        return Error{ "apply: region [" + std::to_string(roi.x0) + ", " + std::to_string(roi.x1) + ") × [" +
                      std::to_string(roi.y0) + ", " + std::to_string(roi.y1) + ") is empty or outside the image of " +
                      size_text(source.full_width, source.full_height) };
    if (job.target.width != roi.x1 - roi.x0 || job.target.height != roi.y1 - roi.y0)
        return Error{ "apply: target is " + size_text(job.target.width, job.target.height) + ", region is " +
                      size_text(roi.x1 - roi.x0, roi.y1 - roi.y0) };
    if (source.x > std::max(roi.x0 - halo, 0) || source.y > std::max(roi.y0 - halo, 0) ||
        source.x + source.pixels.width < std::min(roi.x1 + halo, source.full_width) ||
        source.y + source.pixels.height < std::min(roi.y1 + halo, source.full_height))
        return Error{ "apply: source of " + size_text(source.pixels.width, source.pixels.height) + " at (" +
                      std::to_string(source.x) + ", " + std::to_string(source.y) + ") does not hold the region and " +
                      std::to_string(halo) + " pixels around it" };
    return {};
}

} // namespace

struct Applier::State : Pipeline {};

Applier::Applier(std::unique_ptr<const State> state) : m_state(std::move(state)) {}
Applier::~Applier() = default;

int Applier::halo() const
{
    return m_state->tone_map->halo();
}

Expected<std::shared_ptr<const Applier>> Applier::create(const Model& model, const Parameters& parameters,
                                                         Direction direction, Precision precision)
{
    return guarded("apply", {}, [&]() -> Expected<std::shared_ptr<const Applier>> {
        if (Status status = check_parameters(parameters, model); !status)
            return status.error();
        const bool reverse = direction == Direction::reverse;
        auto pipeline = std::make_unique<State>();
        pipeline->direction = direction;
        pipeline->rebuilds_highlights = model_data(model).rebuilds_highlights(parameters.gain);
        pipeline->tone_map = mix_tone_map(reverse ? model_data(model).tone_reverse : model_data(model).tone_forward,
                                          parameters.tone_weights, tone_method(precision));
        pipeline->color = reverse ? inverse(parameters.color) : parameters.color;
        pipeline->exponent = reverse ? parameters.gamma : 1 / parameters.gamma;
        for (int c = 0; c < 3; ++c) {
            pipeline->white_balance[c] = reverse ? 1 / parameters.white_balance[c] : parameters.white_balance[c];
            pipeline->gain[c] = reverse ? 1 / parameters.gain : parameters.gain;
        }
        return std::shared_ptr<const Applier>(new Applier(std::move(pipeline)));
    });
}

Status Applier::run(const ImagePart& source, Roi roi, MutableImageView target, const ApplyOptions& options) const
{
    return guarded("apply", {}, [&]() -> Status {
        const Job job{ source, roi, target };
        if (Status status = check_job(job, halo()); !status)
            return status;
        const int threads = options.threads > 0 ? options.threads : OIIO::get_int_attribute("threads", 1);
        Progress progress(options, std::int64_t(target.width) * target.height);
        if (share_memory(source.pixels, target))
            run_in_place(*m_state, job, threads, progress);
        else
            run_tiles(*m_state, job, threads, progress);
        return progress.cancelled() ? Status(Error{ "apply: cancelled" }) : Status();
    });
}

Status Applier::run(ImageView source, MutableImageView target, const ApplyOptions& options) const
{
    return run({ source, 0, 0, source.width, source.height }, { 0, source.width, 0, source.height }, target, options);
}

} // namespace srisp
