// SPDX-License-Identifier: Apache-2.0
#include "photo_sample.h"

#include <algorithm>

#include <srisp/thumbnail.h>

#include "../common/interrupt.h"
#include "../common/require.h"
#include "photo/photo_reader.h"

namespace srisp::tool {

namespace {

constexpr int kTilesPerSide = 4, kTileSize = 96;

/// The part `index` of `size` pixels, in the middle of its share.
void middle_of_share(int size, int index, int& from, int& to)
{
    const int first = size * index / kTilesPerSide, last = size * (index + 1) / kTilesPerSide;
    const int length = std::min(last - first, kTileSize);
    from = first + (last - first - length) / 2;
    to = from + length;
}

PhotoSample empty_sample(const std::string& name, int width, int height)
{
    PhotoSample sample{ name, width, height, {}, {} };
    for (int row = 0; row < kTilesPerSide; ++row)
        for (int column = 0; column < kTilesPerSide; ++column) {
            Roi roi;
            middle_of_share(width, column, roi.x0, roi.x1);
            middle_of_share(height, row, roi.y0, roi.y1);
            if (roi.x0 == roi.x1 || roi.y0 == roi.y1)
                continue; // fewer pixels than parts
            const Roi held{ std::max(roi.x0 - PhotoSample::kHalo, 0), std::min(roi.x1 + PhotoSample::kHalo, width),
                            std::max(roi.y0 - PhotoSample::kHalo, 0), std::min(roi.y1 + PhotoSample::kHalo, height) };
            sample.tiles.push_back({ roi, held, {} });
        }
    return sample;
}

/// `rows`: rows y0 and below of the whole width.
void add_rows(PhotoSample& sample, ImageView rows, int y0)
{
    for (PhotoSample::Tile& tile : sample.tiles)
        for (int y = std::max(y0, tile.held.y0); y < std::min(y0 + rows.height, tile.held.y1); ++y)
            tile.rgb.insert(tile.rgb.end(), rows.pixel(tile.held.x0, y - y0), rows.pixel(tile.held.x1, y - y0));
}

} // namespace

PhotoSample read_photo_sample(const std::string& path)
{
    PhotoFile photo = require(PhotoFile::open(path));
    PhotoSample sample = empty_sample(path, photo.width(), photo.height());
    ThumbnailBuilder builder(sample.width, sample.height);
    require(photo.reader().read_all([&](ImageView rows, int y0) {
        check_interrupt();
        builder.add_rows(rows);
        add_rows(sample, rows, y0);
        return Status();
    }));
    sample.thumbnail = builder.finish(photo.orientation());
    return sample;
}

PhotoSample sample_of_thumbnail(const Thumbnail& picture, const std::string& name)
{
    PhotoSample sample = empty_sample(name, kThumbnailSize, kThumbnailSize);
    add_rows(sample, picture.view(), 0);
    sample.thumbnail = picture;
    return sample;
}

} // namespace srisp::tool
