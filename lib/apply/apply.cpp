// SPDX-License-Identifier: Apache-2.0
#include <srisp/apply.h>

#include <algorithm>

#include <OpenImageIO/imageio.h>
#include <srisp/model.h>

#include "apply/job.h"
#include "apply/pointwise_pipeline.h"
#include "apply/tiled_pipeline.h"
#include "base/guarded.h"
#include "base/parallel.h"
#include "model/model_data.h"

namespace srisp {

namespace {

// Rows that are copied at a time where the target is the source: enough for tall tiles, and of wide images some 64 MB.
constexpr int kMinBandRows = 128, kMaxBandRows = 512;
constexpr std::ptrdiff_t kBandBytes = std::ptrdiff_t(64) << 20;

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

/// Where source and target share memory: band by band from a copy, whose upper neighbours were copied before the band
/// above was overwritten.
void run_in_place(const Pipeline& pipeline, const Job& job, int threads, Progress& progress)
{
    const int halo = pipeline.halo();
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
        pipeline.run(band, threads, progress);
    }
}

bool share_memory(ImageView a, ImageView b)
{
    const auto end = [](ImageView v) { return v.pixel(v.width - 1, v.height - 1) + 3; };
    return std::less<>()(a.data, end(b)) && std::less<>()(b.data, end(a));
}

/// Whether each pixel of the region lies where its result goes.
bool same_pixels(const Job& job)
{
    const ImageView& pixels = job.source.pixels;
    return job.first_source_pixel() == job.target.data && pixels.x_stride == job.target.x_stride &&
           (pixels.y_stride == job.target.y_stride || job.target.height == 1);
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

ColorBlocks color_blocks(const Parameters& parameters, Direction direction, bool rebuilds_highlights)
{
    const bool reverse = direction == Direction::reverse;
    ColorBlocks blocks{};
    blocks.color = reverse ? inverse(parameters.color) : parameters.color;
    blocks.exponent = reverse ? parameters.gamma : 1 / parameters.gamma;
    for (int c = 0; c < 3; ++c) {
        blocks.white_balance[c] = reverse ? 1 / parameters.white_balance[c] : parameters.white_balance[c];
        blocks.gain[c] = reverse ? 1 / parameters.gain : parameters.gain;
    }
    blocks.rebuilds_highlights = rebuilds_highlights;
    return blocks;
}

} // namespace

struct Applier::State {
    std::unique_ptr<const Pipeline> pipeline;
};

Applier::Applier(std::unique_ptr<const State> state) : m_state(std::move(state)) {}
Applier::~Applier() = default;

int Applier::halo() const
{
    return m_state->pipeline->halo();
}

Expected<std::shared_ptr<const Applier>> Applier::create(const Model& model, const Parameters& parameters,
                                                         Direction direction, Precision precision)
{
    return guarded("apply", {}, [&]() -> Expected<std::shared_ptr<const Applier>> {
        if (Status status = check_parameters(parameters, model); !status)
            return status.error();
        const ModelData& data = model_data(model);
        const bool reverse = direction == Direction::reverse;
        const ColorBlocks blocks = color_blocks(parameters, direction, data.rebuilds_highlights(parameters.gain));
        const ToneDictionary& dictionary = reverse ? data.tone_reverse : data.tone_forward;
        auto state = std::make_unique<State>();
        if (data.kernel_size == 1)
            state->pipeline = std::make_unique<PointwisePipeline>(
                direction,
                PixelPipeline{ pack_pixel_tone_map(mix_layers(dictionary, parameters.tone_weights)), blocks },
                precision);
        else
            state->pipeline = std::make_unique<TiledPipeline>(
                direction, blocks, mix_tone_map(dictionary, parameters.tone_weights, tone_method(precision)));
        return std::shared_ptr<const Applier>(new Applier(std::move(state)));
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
        const Pipeline& pipeline = *m_state->pipeline;
        if (share_memory(source.pixels, target) && (pipeline.halo() > 0 || !same_pixels(job)))
            run_in_place(pipeline, job, threads, progress);
        else
            pipeline.run(job, threads, progress);
        return progress.cancelled() ? Status(Error{ "apply: cancelled" }) : Status();
    });
}

Status Applier::run(ImageView source, MutableImageView target, const ApplyOptions& options) const
{
    return run({ source, 0, 0, source.width, source.height }, { 0, source.width, 0, source.height }, target, options);
}

} // namespace srisp
