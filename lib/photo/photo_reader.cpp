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
constexpr int kPartsOfSmallPhotos = 4;

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
    m_band_rows = rows_in_tiles(rows_of_part(kBandPixels, spec, kPartsOfSmallPhotos), spec);
}

std::shared_ptr<PhotoRows> PhotoReader::make_room(int y0, int y1)
{
    const std::size_t pixels = std::size_t(y1 - y0) * std::size_t(m_width);
    const bool has_gain_map = m_subimage == 0 && m_miplevel == 0 && m_source.gain_map();
    auto rows = std::make_shared<PhotoRows>();
    rows->width = m_width;
    rows->y0 = y0;
    rows->y1 = y1;
    rows->rgb = m_memory.floats(pixels * 3);
    if (!m_converter.is_rgb_alone())
        rows->stored = m_memory.floats(pixels * std::size_t(m_channels));
    if (has_gain_map)
        rows->headroom = m_memory.floats(pixels);
    rows->row_counts.resize(std::size_t(y1 - y0));
    return rows;
}

/// Of rows y0 ≤ y < y1 of two sets, so many floats each.
static void copy_rows(const PhotoRows& from, const PhotoRows& to, int y0, int y1,
                      std::shared_ptr<float[]> PhotoRows::*plane, std::size_t row)
{
    if ((to.*plane))
        std::copy_n((from.*plane).get() + row * std::size_t(y0 - from.y0), row * std::size_t(y1 - y0),
                    (to.*plane).get() + row * std::size_t(y0 - to.y0));
}

/// The rows from `first` on.
Status PhotoReader::read_and_convert(PhotoRows& rows, int first)
{
    const std::size_t width = std::size_t(m_width), skipped = width * std::size_t(first - rows.y0);
    float* const stored =
        rows.stored ? rows.stored.get() + skipped * std::size_t(m_channels) : rows.rgb.get() + skipped * 3;
    if (const Status read = m_source.read_rows(m_subimage, m_miplevel, first, rows.y1, stored); !read)
        return read;
    parallel_tasks(rows.y1 - first, m_threads, [&](std::int64_t row) {
        const int y = first + static_cast<int>(row);
        const std::size_t pixel = width * std::size_t(y - rows.y0);
        float* const rgb = rows.rgb.get() + pixel * 3;
        const float* const in = rows.stored ? rows.stored.get() + pixel * std::size_t(m_channels) : rgb;
        m_converter.to_rgb(in, m_width, rgb, rows.row_counts[std::size_t(y - rows.y0)]);
        if (rows.headroom)
            apply_gain_map(*m_source.gain_map(), y, m_width, rgb, rows.headroom.get() + pixel);
    });
    return {};
}

Expected<std::shared_ptr<const PhotoRows>> PhotoReader::rows(int y0, int y1)
{
    auto last = m_last;
    const bool overlap = last && last->y0 <= y0 && y0 < last->y1;
    if (!overlap) { // its memory serves again
        last.reset();
        m_last.reset();
    }
    const auto rows = make_room(y0, y1);
    const int first = overlap ? std::min(last->y1, y1) : y0;
    if (overlap) {
        const std::size_t width = std::size_t(m_width);
        copy_rows(*last, *rows, y0, first, &PhotoRows::rgb, width * 3);
        copy_rows(*last, *rows, y0, first, &PhotoRows::stored, width * std::size_t(m_channels));
        copy_rows(*last, *rows, y0, first, &PhotoRows::headroom, width);
        std::copy_n(last->row_counts.begin() + (y0 - last->y0), first - y0, rows->row_counts.begin());
    }
    if (first < y1)
        if (const Status read = read_and_convert(*rows, first); !read)
            return read.error();
    m_last = rows;
    return std::shared_ptr<const PhotoRows>(rows);
}

Expected<std::shared_ptr<const PhotoRows>> PhotoReader::next(int y0)
{
    return rows(y0, std::min(y0 + m_band_rows, m_height));
}

Status PhotoReader::read_all(const std::function<Status(ImageView rows, int y0)>& use)
{
    for (int y = 0; y < m_height; y += m_band_rows) {
        const auto read = next(y);
        if (!read)
            return read.error();
        m_counts += (*read)->counts((*read)->y0, (*read)->y1);
        if (Status used = use((*read)->view(), y); !used)
            return used;
    }
    return {};
}

Expected<Thumbnail> PhotoReader::thumbnail(const std::function<bool()>& cancelled)
{
    ThumbnailBuilder builder(m_width, m_height);
    const Status read = read_all([&](ImageView rows, int) -> Status {
        if (cancelled && cancelled())
            return Error{ m_source.name() + ": cancelled" };
        builder.add_rows(rows);
        return {};
    });
    if (!read)
        return read.error();
    return builder.finish(m_orientation);
}

Expected<PhotoFile> PhotoFile::open(const ImageInput& photo, const Options& options)
{
    auto source = open_source(photo, "photo", reading_hints(options));
    if (!source)
        return source.error();
    const std::string& where = (*source)->name();
    auto spec = (*source)->find_level(0, 0);
    if (!spec)
        return Error{ where + ": has no picture" };
    auto converter = PhotoConverter::create(*spec, options.input, where);
    if (!converter)
        return converter.error();
    return PhotoFile(std::move(*source), std::move(*spec), std::move(*converter), options.threads);
}

std::vector<std::string> PhotoFile::notes(const PhotoCounts& counts) const
{
    std::vector<std::string> all = m_converter.notes();
    for (const auto& more : { m_source->notes(), counts.notes() })
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

Expected<Thumbnail> load_photo_thumbnail(const ImageInput& photo, const Options& options,
                                         const std::function<bool()>& cancelled)
{
    return guarded("photo", photo.name(), [&] {
        auto file = PhotoFile::open(photo, options);
        return file ? file->reader().thumbnail(cancelled) : Expected<Thumbnail>(file.error());
    });
}

} // namespace srisp
