// SPDX-License-Identifier: Apache-2.0
#include <srisp/photo_thumbnail.h>

#include <algorithm>

#include <srisp/thumbnail.h>

#include "photo/photo_file.h"

namespace srisp {

Expected<Thumbnail> load_photo_thumbnail(const std::string& path)
{
    try {
        auto photo = PhotoFile::open(path);
        if (!photo)
            return photo.error();
        ThumbnailBuilder builder(photo->width(), photo->height());
        for (int y = 0; y < photo->height(); y += photo->band_rows()) {
            const int end = std::min(y + photo->band_rows(), photo->height());
            const auto rows = photo->read(y, end);
            if (!rows)
                return rows.error();
            builder.add_rows({ *rows, photo->width(), end - y, 3, std::ptrdiff_t(3) * photo->width() });
        }
        return builder.finish(photo->orientation());
    } catch (const std::exception& failed) {
        return Error{ "photo '" + path + "': " + failed.what() };
    }
}

} // namespace srisp
