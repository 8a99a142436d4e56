// SPDX-License-Identifier: Apache-2.0
#include "result/band_reader.h"

#include <algorithm>
#include <cstdio>

#include "container/image_limits.h"
#include "photo/headroom.h"

namespace srisp {

namespace {

constexpr int kBandRows = 256;
constexpr int kLeastBandRows = 32;
constexpr int kBandPixels = 2 << 20; // 24 MB of RGB
constexpr std::size_t kBandsKept = 2;

/// Rows of one band: as many as a few megabytes hold, and whole tiles.
int band_rows(const OIIO::ImageSpec& spec)
{
    const int rows = std::clamp(kBandPixels / std::max(spec.width, 1), kLeastBandRows, kBandRows);
    return rows_in_tiles(rows, spec);
}

} // namespace

BandReader::BandReader(PixelSource& source, int subimage, int miplevel, const OIIO::ImageSpec& stored,
                       BandSettings settings)
    : m_source(source), m_width(stored.width), m_height(stored.height), m_stored_channels(stored.nchannels),
      m_channels(settings.converter->output_spec().nchannels), m_band_rows(band_rows(stored)),
      m_settings(std::move(settings)),
      m_reader(source, subimage, miplevel, stored, *m_settings.converter, m_settings.threads),
      m_done(std::size_t((stored.height - 1) / m_band_rows + 1)), m_progress(m_settings.progress)
{
}

Status BandReader::read(int x0, int x1, int y0, int y1, float* out, std::size_t row_stride)
{
    for (int y = y0; y < y1;) {
        const int index = y / m_band_rows;
        const auto found = band(index);
        if (!found)
            return found.error();
        const int end = std::min((index + 1) * m_band_rows, y1);
        for (; y < end; ++y, out += row_stride) {
            const std::size_t pixel = std::size_t(y - index * m_band_rows) * m_width;
            std::copy((*found)->values.data() + (pixel + x0) * m_channels,
                      (*found)->values.data() + (pixel + x1) * m_channels, out);
        }
    }
    return {};
}

Expected<std::shared_ptr<const BandReader::Band>> BandReader::band(int index)
{
    for (const auto& kept : m_last)
        if (kept->index == index)
            return kept;
    auto computed = compute(index);
    if (!computed)
        return computed;
    m_last.insert(m_last.begin(), *computed);
    m_last.resize(std::min(m_last.size(), kBandsKept));
    return computed;
}

Expected<std::shared_ptr<const BandReader::Band>> BandReader::compute(int index)
{
    const int y0 = index * m_band_rows, y1 = std::min(y0 + m_band_rows, m_height);
    const int halo = m_settings.applier->halo();
    const int first = std::max(y0 - halo, 0), last = std::min(y1 + halo, m_height);
    const auto rows = m_reader.rows(first, last);
    if (!rows)
        return rows.error();
    const ImagePart source{ rows->view(), 0, first, m_width, m_height };
    const std::ptrdiff_t stride = source.pixels.y_stride;
    std::vector<float> result(std::size_t(stride) * (y1 - y0));
    ApplyOptions options;
    options.threads = m_settings.threads;
    options.progress = [&](float part) {
        m_progress.show([&] {
            char text[32];
            std::snprintf(text, sizeof text, "srisp: %3.0f %%", (m_bands_done + part) / m_done.size() * 100.0);
            return std::string(text);
        });
        return true;
    };
    const Status applied = m_settings.applier->run(source, Roi{ 0, m_width, y0, y1 },
                                                   { result.data(), m_width, y1 - y0, 3, stride }, options);
    if (!applied)
        return Error{ m_source.name() + ": " + applied.error().message };

    if (!rows->headroom.empty())
        add_headroom(rows->headroom.data() + std::size_t(m_width) * (y0 - first), std::int64_t(m_width) * (y1 - y0),
                     result.data());

    auto computed = std::make_shared<Band>(Band{ index, {} });
    computed->values.resize(std::size_t(m_width) * (y1 - y0) * m_channels);
    const float* const stored = rows->stored->data() + std::size_t(m_width) * m_stored_channels * (y0 - first);
    m_settings.converter->from_rgb(result.data(), stored, std::int64_t(m_width) * (y1 - y0), m_settings.associate,
                                   computed->values.data());
    if (!m_done[index]) {
        m_done[index] = true;
        ++m_bands_done;
        m_counts += rows->counts(y0, y1);
    }
    if (complete())
        m_progress.wipe();
    return std::shared_ptr<const Band>(computed);
}

} // namespace srisp
