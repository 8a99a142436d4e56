// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>
#include <srisp/photo.h>

namespace srisp {

/// A photo on disk, read as display-encoded sRGB in bands of rows: the image as a whole is never in memory. One thread.
class PhotoFile {
public:
    /// Opens any image that OpenImageIO reads and takes its first subimage. Errors start with "photo 'path': ":
    /// missing, no image, nothing that can be a photo (see PhotoConverter).
    static Expected<PhotoFile> open(const std::string& path);

    /// As stored, pixels of the data window; `orientation` (EXIF, 1 … 8) turns them upright.
    int width() const { return m_width; }
    int height() const { return m_height; }
    int orientation() const { return m_orientation; }

    /// Rows that are read at a time: a few megabytes, and whole tiles.
    int band_rows() const { return m_band_rows; }
    /// Rows y0 ≤ y < y1 as interleaved RGB in [0,1]; valid until the next call.
    Expected<const float*> read(int y0, int y1);
    /// What conversion changed so far.
    const PhotoCounts& counts() const { return m_counts; }

private:
    PhotoFile(std::string where, std::unique_ptr<OIIO::ImageInput> input, PhotoConverter converter);

    std::string m_where;
    std::unique_ptr<OIIO::ImageInput> m_input;
    PhotoConverter m_converter;
    int m_width, m_height, m_channels, m_orientation, m_band_rows;
    std::vector<float> m_stored, m_rgb;
    PhotoCounts m_counts;
};

} // namespace srisp
