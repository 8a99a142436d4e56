// SPDX-License-Identifier: Apache-2.0
#include "photo/photo_reader.h"

#include <algorithm>

#include <srisp/photo.h>
#include <srisp/thumbnail.h>

#include "base/guarded.h"
#include "base/parallel.h"
#include "container/image_limits.h"
#include "photo/headroom.h"

namespace srisp {

namespace {

constexpr int kBandPixels = 1 << 18; // 3 MB of RGB

} // namespace

PhotoCounts PhotoRows::counts(int first, int last) const
{
    PhotoCounts sum;
    for (int y = first; y < last; ++y)
        sum += row_counts[y - y0];
    return sum;
}

PhotoReader::PhotoReader(PixelSource& source, int subimage, int miplevel, const OIIO::ImageSpec& spec,
                         const PhotoConverter& converter, int threads)
    : m_source(source), m_converter(converter), m_subimage(subimage), m_miplevel(miplevel), m_width(spec.width),
      m_height(spec.height), m_channels(spec.nchannels), m_orientation(spec.get_int_attribute("Orientation", 1)),
      m_threads(threads)
{
    m_band_rows = rows_in_tiles(std::max(kBandPixels / std::max(m_width, 1), 1), spec);
}

Expected<PhotoReader::StoredRows> PhotoReader::stored_rows(int y0, int y1)
{
    const StoredRows last = m_last;
    const int last_y0 = m_last_y0, last_y1 = m_last_y1;
    const std::size_t row = std::size_t(m_width) * m_channels;
    const auto values = std::make_shared<std::vector<float>>(row * (y1 - y0));
    int first = y0;
    if (last_y0 <= y0 && y0 < last_y1) {
        first = std::min(last_y1, y1);
        std::copy_n(last->data() + row * (y0 - last_y0), row * (first - y0), values->data());
    }
    if (first < y1)
        if (const Status read =
                m_source.read_rows(m_subimage, m_miplevel, first, y1, values->data() + row * (first - y0));
            !read)
            return read.error();
    m_last = values;
    m_last_y0 = y0;
    m_last_y1 = y1;
    return StoredRows(values);
}

Expected<PhotoRows> PhotoReader::rows(int y0, int y1)
{
    const auto stored = stored_rows(y0, y1);
    if (!stored)
        return stored.error();
    const std::size_t count = std::size_t(y1 - y0), row = std::size_t(m_width);
    const GainMap* const gain_map = m_subimage == 0 && m_miplevel == 0 ? m_source.gain_map() : nullptr;
    PhotoRows rows{
        m_width, y0, y1, *stored, std::vector<float>(count * row * 3), {}, std::vector<PhotoCounts>(count)
    };
    if (gain_map)
        rows.headroom.resize(count * row);
    const auto convert = [&](std::int64_t y) {
        float* const rgb = rows.rgb.data() + y * row * 3;
        m_converter.to_rgb(rows.stored->data() + y * row * m_channels, m_width, rgb, rows.row_counts[y]);
        if (gain_map)
            apply_gain_map(*gain_map, y0 + static_cast<int>(y), m_width, rgb, rows.headroom.data() + y * row);
    };
    parallel_tasks(y1 - y0, m_threads, convert);
    return rows;
}

Status PhotoReader::read_all(const std::function<Status(ImageView rows, int y0)>& use)
{
    for (int y = 0; y < m_height; y += m_band_rows) {
        const auto read = rows(y, std::min(y + m_band_rows, m_height));
        if (!read)
            return read.error();
        m_counts += read->counts(read->y0, read->y1);
        if (Status used = use(read->view(), y); !used)
            return used;
    }
    return {};
}

Expected<Thumbnail> PhotoReader::thumbnail()
{
    ThumbnailBuilder builder(m_width, m_height);
    const Status read = read_all([&](ImageView rows, int) {
        builder.add_rows(rows);
        return Status();
    });
    if (!read)
        return read.error();
    return builder.finish(m_orientation);
}

Expected<PhotoFile> PhotoFile::open(const std::string& path, const Options& options)
{
    auto source = open_file_source(path, "photo", reading_hints(options));
    if (!source)
        return source.error();
    const std::string& where = (*source)->name();
    auto spec = (*source)->find_level(0, 0);
    if (!spec)
        return Error{ where + ": has no picture" };
    auto converter = PhotoConverter::create(*spec, options.input, where);
    if (!converter)
        return converter.error();
    return PhotoFile(std::move(*source), std::move(*spec), std::move(*converter));
}

std::vector<std::string> PhotoFile::notes(const PhotoCounts& counts) const
{
    std::vector<std::string> all = m_converter.notes();
    for (const auto& more : { m_source->notes(), counts.notes() })
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

Expected<Thumbnail> load_photo_thumbnail(const std::string& path)
{
    return guarded("photo", path, [&] {
        auto photo = PhotoFile::open(path);
        return photo ? photo->reader().thumbnail() : Expected<Thumbnail>(photo.error());
    });
}

} // namespace srisp
