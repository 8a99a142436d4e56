// SPDX-License-Identifier: Apache-2.0
#include "pack_tasks.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <srisp/reference.h>

#include "../common/interrupt.h"
#include "base/matrix3.h"
#include "crops.h"
#include "photo/photo_reader.h"
#include "thumbnail/area_squasher.h"

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
    Options options;
    options.threads = 1; // the others have photos of their own
    Expected<PhotoFile> photo = PhotoFile::open(path, options);
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

namespace {

std::string lower(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

/// "Nikon D1" of make "NIKON CORPORATION" and model "NIKON D1", or "Nikon" and "D1".
std::string camera_name(const CameraFacts& facts)
{
    const std::string first_word = facts.make.substr(0, facts.make.find(' '));
    if (facts.model.empty())
        return facts.make.empty() ? "unknown camera" : facts.make;
    const bool named = lower(facts.model).compare(0, first_word.size(), lower(first_word)) == 0;
    return named ? facts.model : first_word + " " + facts.model;
}

/// The gains that make the as-shot neutral grey.
void set_white_balance(const CameraFacts& facts, PackEntry& image)
{
    const std::array<float, 3>& neutral = facts.as_shot_neutral;
    if (std::all_of(neutral.begin(), neutral.end(), [](float v) { return v > 0 && std::isfinite(v); }))
        image.white_balance = { neutral[1] / neutral[0], 1, neutral[1] / neutral[2] };
}

/// From XYZ → camera: times linear sRGB → XYZ, rows divided by their sum (which takes the white balance out), inverted.
/// [method 4, as UPI]
void set_color(const CameraFacts& facts, PackEntry& image)
{
    const CameraFacts::ColorMatrix* found = facts.daylight_matrix();
    if (!found)
        return;
    const Matrix3 camera = product(found->xyz_to_camera, kSrgbToXyz);
    for (int row = 0; row < 3; ++row)
        if (!(camera[row * 3] + camera[row * 3 + 1] + camera[row * 3 + 2] > 1e-3f))
            return;
    const Matrix3 normalized = row_normalized(camera);
    if (std::fabs(determinant(normalized)) > 1e-3)
        image.color = inverse(normalized);
}

/// A part of the thumbnail.
std::vector<float> squashed(const Thumbnail& thumbnail, const Roi& crop, int size)
{
    AreaSquasher squasher(crop.x1 - crop.x0, crop.y1 - crop.y0, size);
    const ImageView view = thumbnail.view();
    squasher.add_rows(
        { view.pixel(crop.x0, crop.y0), crop.x1 - crop.x0, crop.y1 - crop.y0, view.x_stride, view.y_stride });
    return squasher.finish(1);
}

Expected<PackedScene> pack_raw(const std::string& path, const std::string& name, const Provenance& provenance,
                               const CropSettings& settings)
{
    const auto reference = load_reference(path);
    if (!reference)
        return reference.error();
    const CameraFacts& facts = (*reference)->facts;
    PackedScene packed;
    packed.enlarged = std::min(facts.width, facts.height) < settings.size;
    PackEntry& image = packed.scene.common;
    image.name = name;
    image.group = camera_name(facts);
    image.source = provenance.source;
    image.licence = provenance.licence;
    image.open = provenance.open;
    image.validation = provenance.validation;
    set_white_balance(facts, image);
    set_color(facts, image);
    for (const Roi& crop : choose_crops(kThumbnailSize, kThumbnailSize, settings.size,
                                        packed.enlarged ? 0 : settings.crops, settings.seed, name)) {
        append_pixels(squashed((*reference)->thumbnail, crop, settings.size), packed.pixels);
        packed.scene.crops.push_back(relative_crop(crop, kThumbnailSize, kThumbnailSize));
    }
    return packed;
}

} // namespace

PackTask raw_task(const std::string& path, const std::string& name, const Provenance& provenance,
                  const CropSettings& settings)
{
    return { path, [=] { return pack_raw(path, name, provenance, settings); } };
}

} // namespace srisp::tool
