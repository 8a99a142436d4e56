// SPDX-License-Identifier: Apache-2.0
#include "result/band_reader.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/printed.h"
#include "container/image_limits.h"
#include "photo/headroom.h"

namespace srisp {

namespace {

constexpr int kBandsKept = 2; // all of a small image

/// Rows of one band, in whole tiles. Where neighbours count, some rows above and below each band are computed twice, so
/// it has as many as a few megabytes hold; elsewhere as many as the caches hold from one step to the next.
int band_rows(const OIIO::ImageSpec& spec, int halo)
{
    struct Limits {
        int least_rows, most_rows, pixels;
    };
    constexpr Limits kAlone{ 16, 1 << 12, 3 << 17 }, kWithNeighbours{ 32, 256, 2 << 20 };
    const Limits& limits = halo > 0 ? kWithNeighbours : kAlone;
    const std::int64_t rows = rows_of_part(limits.pixels, spec, halo > 0 ? 1 : kBandsKept);
    return rows_in_tiles(std::clamp<std::int64_t>(rows, limits.least_rows, limits.most_rows), spec);
}

} // namespace

BandReader::BandReader(PixelSource& source, int subimage, int miplevel, const OIIO::ImageSpec& stored,
                       BandSettings settings)
    : m_source(source), m_settings(std::move(settings)), m_width(stored.width), m_height(stored.height),
      m_stored_channels(stored.nchannels), m_channels(m_settings.converter->output_spec().nchannels),
      m_band_rows(band_rows(stored, m_settings.applier->halo())),
      m_reader(source, subimage, miplevel, stored, *m_settings.converter, m_settings.threads),
      m_done(std::size_t((stored.height - 1) / m_band_rows + 1)), m_progress(m_settings.progress)
{
}

int BandReader::end_of(int band) const
{
    return std::min((band + 1) * m_band_rows, m_height);
}

Status BandReader::read(int x0, int x1, int y0, int y1, float* out, std::size_t row_stride)
{
    for (int y = y0; y < y1;) {
        const int index = y / m_band_rows, first = index * m_band_rows;
        const int end = std::min(end_of(index), y1);
        const bool whole = x0 == 0 && x1 == m_width && y == first && end == end_of(index);
        if (whole && !kept(index)) {
            if (const Status computed = compute(index, { out, row_stride }); !computed)
                return computed;
            out += row_stride * std::size_t(end - y);
            y = end;
            continue;
        }
        const auto found = band(index);
        if (!found)
            return found.error();
        const float* const values = (*found)->values.get();
        for (; y < end; ++y, out += row_stride) {
            const std::size_t pixel = std::size_t(y - first) * m_width;
            std::copy(values + (pixel + x0) * m_channels, values + (pixel + x1) * m_channels, out);
        }
    }
    return {};
}

std::shared_ptr<const BandReader::Band> BandReader::kept(int index) const
{
    for (const auto& band : m_last)
        if (band->index == index)
            return band;
    return nullptr;
}

Expected<std::shared_ptr<const BandReader::Band>> BandReader::band(int index)
{
    if (auto found = kept(index))
        return found;
    const std::size_t row = std::size_t(m_width) * m_channels;
    m_last.resize(std::min<std::size_t>(m_last.size(), kBandsKept - 1)); // memory of the last one serves again
    const auto made =
        std::make_shared<Band>(Band{ index, m_memory.floats(row * (end_of(index) - index * m_band_rows)) });
    if (const Status computed = compute(index, { made->values.get(), row }); !computed)
        return computed.error();
    m_last.insert(m_last.begin(), made);
    return std::shared_ptr<const Band>(made);
}

Status BandReader::compute(int index, Target target)
{
    const int y0 = index * m_band_rows, y1 = end_of(index);
    const int halo = m_settings.applier->halo();
    const auto read = m_reader.rows(std::max(y0 - halo, 0), std::min(y1 + halo, m_height));
    if (!read)
        return read.error();
    const PhotoRows& rows = **read;
    const Roi roi{ 0, m_width, y0, y1 };
    if (!rows.stored) {
        if (const Status applied = apply(rows, roi, target); !applied)
            return applied;
    } else {
        const std::size_t row = std::size_t(m_width) * 3;
        const auto rgb = m_memory.floats(row * std::size_t(y1 - y0));
        if (const Status applied = apply(rows, roi, { rgb.get(), row }); !applied)
            return applied;
        parallel_tasks(y1 - y0, m_settings.threads, [&](std::int64_t y) {
            const std::size_t stored = std::size_t(m_width) * std::size_t(m_stored_channels);
            m_settings.converter->from_rgb(rgb.get() + row * y, rows.stored.get() + stored * (y0 - rows.y0 + y),
                                           m_width, m_settings.associate, target.values + target.row_stride * y);
        });
    }
    if (!m_done[index]) {
        m_done[index] = true;
        ++m_bands_done;
        m_counts += rows.counts(y0, y1);
    }
    if (complete())
        m_progress.wipe();
    return {};
}

/// The model, and what is brighter than the photo says; three channels.
Status BandReader::apply(const PhotoRows& rows, Roi roi, Target rgb)
{
    ApplyOptions options;
    options.threads = m_settings.threads;
    options.progress = [&](float part) {
        m_progress.show([&] { return printed("srisp: %3.0f %%", (m_bands_done + part) / m_done.size() * 100.0); });
        return !m_settings.cancelled || !m_settings.cancelled();
    };
    const int height = roi.y1 - roi.y0;
    const Status applied =
        m_settings.applier->run({ rows.view(), 0, rows.y0, m_width, m_height }, roi,
                                { rgb.values, m_width, height, 3, std::ptrdiff_t(rgb.row_stride) }, options);
    if (!applied)
        return Error{ m_source.name() + ": " + applied.error().message };
    if (rows.headroom)
        for (int y = 0; y < height; ++y)
            add_headroom(rows.headroom.get() + std::size_t(m_width) * (roi.y0 - rows.y0 + y), m_width,
                         rgb.values + rgb.row_stride * y);
    return {};
}

} // namespace srisp
