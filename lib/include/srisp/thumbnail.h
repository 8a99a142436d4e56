// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <srisp/export.h>
#include <srisp/image.h>

namespace srisp {

/// Squashes an image to a Thumbnail by exact area averaging: each output pixel is the mean of the input area that it
/// covers, fractions of pixels counted; the same rule when enlarging. Rows are given once each, from top to bottom, so
/// that the image itself need never be in memory. Sums are double. One object per thread.
class SRISP_API ThumbnailBuilder {
public:
    /// `width`, `height`: size of the whole image in pixels, at least 1 × 1.
    ThumbnailBuilder(int width, int height);
    ~ThumbnailBuilder();
    ThumbnailBuilder(ThumbnailBuilder&&) noexcept;
    ThumbnailBuilder& operator=(ThumbnailBuilder&&) noexcept;

    /// Adds the next `rows.height` rows; `rows.width` is the width of the image.
    void add_rows(ImageView rows);
    /// The thumbnail once all rows were added, turned upright: `orientation` is the EXIF orientation (1 … 8) of the
    /// rows.
    Thumbnail finish(int orientation) const;

private:
    struct State;
    std::unique_ptr<State> m_state;
};

/// The thumbnail of an image that is in memory; `orientation` as in EXIF (1 … 8). [method: thumbnails]
SRISP_API Thumbnail make_thumbnail(ImageView image, int orientation = 1);

/// Turns a thumbnail upright: what an EXIF `orientation` (1 … 8; others are taken as 1) asks for.
SRISP_API Thumbnail oriented(const Thumbnail& thumbnail, int orientation);

} // namespace srisp
