// SPDX-License-Identifier: Apache-2.0
#include "photo_task.h"

#include <algorithm>

#include "../common/interrupt.h"
#include "photo/photo_reader.h"
#include "thumbnail/area_squasher.h"

#include "crops.h"

namespace srisp::tool {

namespace {

/// One crop on its way.
struct Squashing {
    Roi stored;
    AreaSquasher squasher;
};

/// Those of the rows y0 and below that lie in the crop.
void add_rows(Squashing& crop, ImageView rows, int y0)
{
    const Roi& stored = crop.stored;
    const int first = std::max(y0, stored.y0), last = std::min(y0 + rows.height, stored.y1);
    if (first < last)
        crop.squasher.add_rows(
            { rows.pixel(stored.x0, first - y0), stored.x1 - stored.x0, last - first, rows.x_stride, rows.y_stride });
}

Status squash(PhotoFile& photo, std::vector<Squashing>& crops)
{
    return photo.reader().read_all([&](ImageView rows, int y0) {
        if (pending_interrupt())
            return Status(Error{ "interrupted" });
        for (Squashing& crop : crops)
            add_rows(crop, rows, y0);
        return Status();
    });
}

Expected<PackedScene> pack_photo(const std::string& path, const std::string& name, const Provenance& provenance,
                                 const CropSettings& settings)
{
    Expected<PhotoFile> photo = PhotoFile::open(path);
    if (!photo)
        return photo.error();
    const int width = photo->width(), height = photo->height(), orientation = photo->orientation();
    if (std::min(width, height) < kSmallestPackImage)
        return Error{ "photo '" + path + "': has " + std::to_string(width) + " x " + std::to_string(height) +
                      " pixels, at least " + std::to_string(kSmallestPackImage) + " a side are needed" };
    const bool turned = orientation >= 5 && orientation <= 8;
    const int upright_width = turned ? height : width, upright_height = turned ? width : height;

    PackedScene packed;
    packed.enlarged = std::min(width, height) < settings.size;
    PackEntry& image = packed.scene.common;
    image.name = name;
    image.group = image.source = provenance.source;
    image.licence = provenance.licence;
    image.open = provenance.open;
    image.validation = provenance.validation;
    std::vector<Squashing> crops;
    for (const Roi& crop :
         choose_crops(upright_width, upright_height, settings.size, settings.crops, settings.seed, name)) {
        const Roi stored = stored_crop(crop, width, height, orientation);
        crops.push_back({ stored, AreaSquasher(stored.x1 - stored.x0, stored.y1 - stored.y0, settings.size) });
        packed.scene.crops.push_back(relative_crop(crop, upright_width, upright_height));
    }
    if (Status status = squash(*photo, crops); !status)
        return status.error();
    for (const Squashing& crop : crops)
        append_pixels(crop.squasher.finish(orientation), packed.pixels);
    return packed;
}

} // namespace

PackTask photo_task(const std::string& path, const std::string& name, const Provenance& provenance,
                    const CropSettings& settings)
{
    return { path, [=] { return pack_photo(path, name, provenance, settings); } };
}

} // namespace srisp::tool
