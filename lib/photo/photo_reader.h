// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <srisp/image.h>

#include "base/spare_memory.h"
#include "photo/photo_converter.h"
#include "photo/pixel_source.h"

namespace srisp {

/// Some rows of one level: all channels as stored, and as display-encoded RGB in [0,1].
struct PhotoRows {
    int width, y0, y1;
    std::shared_ptr<float[]> rgb;
    std::shared_ptr<float[]> stored;   ///< null: they are RGB alone, and no result needs them
    std::shared_ptr<float[]> headroom; ///< of each pixel: how much brighter its light is than `rgb` says; null: nowhere
    std::vector<PhotoCounts> row_counts; ///< what conversion changed in each row

    ImageView view() const { return { rgb.get(), width, y1 - y0, 3, std::ptrdiff_t(3) * width }; }
    /// What conversion changed in rows first ≤ y < last.
    PhotoCounts counts(int first, int last) const;
};

/// Reads one level of a photo in bands of rows: the image as a whole is never in memory. Bands may overlap by a halo;
/// since sources are read fastest from top to bottom, where going back means decoding again from the start, rows that
/// were read just before are kept, not read again. Not for use by several threads at a time, but a call may be made
/// within a call.
class PhotoReader {
public:
    /// `spec`: that of the level; `source` and `converter` outlive this; `threads` convert: 0 for all of OpenImageIO's,
    /// 1 for the calling one.
    PhotoReader(PixelSource& source, int subimage, int miplevel, const OIIO::ImageSpec& spec,
                const PhotoConverter& converter, int threads);

    /// Rows y0 ≤ y < y1 of the data window.
    Expected<std::shared_ptr<const PhotoRows>> rows(int y0, int y1);
    /// The rows from y0 on that are read at a time, some megabytes.
    Expected<std::shared_ptr<const PhotoRows>> next(int y0);

    /// Calls use(rows, y0) for all rows once, from top to bottom, some megabytes at a time; its error ends the pass.
    Status read_all(const std::function<Status(ImageView rows, int y0)>& use);
    /// All rows once, squashed and turned upright. `cancelled`: asked now and then; true ends it.
    Expected<Thumbnail> thumbnail(const std::function<bool()>& cancelled = {});
    /// What conversion changed in the rows of `read_all`.
    const PhotoCounts& counts() const { return m_counts; }

private:
    std::shared_ptr<PhotoRows> make_room(int y0, int y1);
    Status read_and_convert(PhotoRows& rows, int first);

    PixelSource& m_source;
    const PhotoConverter& m_converter;
    int m_subimage, m_miplevel, m_width, m_height, m_channels, m_orientation, m_band_rows, m_threads;
    SpareMemory m_memory;
    std::shared_ptr<const PhotoRows> m_last; ///< the rows that were read last
    PhotoCounts m_counts;
};

/// A photo, whole, read as PhotoReader does.
class PhotoFile {
public:
    /// Opens any image that OpenImageIO reads and takes its first picture; of the options `input`, `gain_map`,
    /// `allow_partial` and `threads` count. Errors start with "photo 'path': ": missing, no image, nothing that can be
    /// a photo (see PhotoConverter).
    static Expected<PhotoFile> open(const ImageInput& photo, const Options& options);

    /// As stored, pixels of the data window; `orientation` (EXIF, 1 … 8) turns them upright.
    int width() const { return m_spec.width; }
    int height() const { return m_spec.height; }
    int orientation() const { return m_spec.get_int_attribute("Orientation", 1); }

    /// What was assumed or changed, one sentence each; `counts`: of the reader that read all of it.
    std::vector<std::string> notes(const PhotoCounts& counts) const;

    PhotoReader reader() { return PhotoReader(*m_source, 0, 0, m_spec, m_converter, m_threads); }

private:
    PhotoFile(std::unique_ptr<PixelSource> source, OIIO::ImageSpec spec, PhotoConverter converter, int threads)
        : m_source(std::move(source)), m_spec(std::move(spec)), m_converter(std::move(converter)), m_threads(threads)
    {
    }

    std::unique_ptr<PixelSource> m_source;
    OIIO::ImageSpec m_spec;
    PhotoConverter m_converter;
    int m_threads;
};

} // namespace srisp
