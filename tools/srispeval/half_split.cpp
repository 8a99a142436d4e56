// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "photo_rendering.h"
#include "protocol.h"

namespace srisp::tool {

namespace {

constexpr int kQuarterTurn = 6; // EXIF orientation

/// Makes two tests of a RAW picture and a photo of it, both wider than high.
void add_halves(const RawPicture& raw, const Pixels& reference, const Pixels& photo, const ImageScore& score,
                std::vector<TestImage>& images)
{
    const int width = photo.width, height = photo.height;
    for (const bool top : { true, false }) {
        const Roi roi{ width - width / 2, width, top ? 0 : height - height / 2, top ? height / 2 : height };
        TestImage image;
        image.score = score;
        image.score.part = top ? "top" : "bottom";
        image.photo = photo.part(roi);
        image.truth = raw.pixels.part(roi);
        image.reference = reference;
        image.colors = raw.colors;
        images.push_back(std::move(image));
    }
}

Expected<TestImages> half_split(const ListedFile& file, const EvalOptions& options, const AskForMemory& ask)
{
    auto loaded = load_raw_picture(file.path, options.size, ask);
    if (!loaded)
        return loaded.error();
    RawPicture& raw = *loaded;
    if (std::min(raw.pixels.width, raw.pixels.height) < 32)
        return Error{ "has " + std::to_string(raw.pixels.width) + " x " + std::to_string(raw.pixels.height) +
                      " pixels; 32 x 32 is the least that can be split" };
    TestImages result;
    const RawPicture upright = raw;
    const bool turn = raw.pixels.height > raw.pixels.width;
    if (turn)
        raw.pixels = oriented(std::move(raw.pixels), kQuarterTurn);
    const Pixels reference = raw.pixels.part({ 0, raw.pixels.width / 2, 0, raw.pixels.height });
    ImageScore score;
    score.image = file.name;
    score.camera = camera_name(raw.file->facts);
    score.reference = "left half";
    score.notes = raw.file->notes;
    for (const std::string& name : options.renderings) {
        auto photo = photo_of_raw(rendering_kind(name), file.path, upright, file.name, options.seed);
        if (!photo) {
            result.left_out.push_back({ file.name, name + ": " + photo.error().message });
            continue;
        }
        if (turn)
            photo = oriented(std::move(*photo), kQuarterTurn);
        score.rendering = name;
        add_halves(raw, reference, *photo, score, result.images);
    }
    return result;
}

} // namespace

Protocol half_split_protocol(const EvalOptions& options)
{
    Protocol protocol;
    protocol.name = "half-split";
    protocol.text = { "Half split, the paper's protocol: the left half of each RAW file is the reference. Of the right "
                      "half a photo is made; its top and its bottom are unprocessed apart, and held against the RAW "
                      "itself, which is linear. A file that is higher than wide is turned first." };
    for (const std::string& name : options.renderings)
        protocol.text.push_back("Rendering \"" + name + "\": " + rendering_kind(name).text + ".");
    protocol.images_per_task = 2 * int(options.renderings.size());
    for (const ListedFile& file : list_raw_files(options.inputs))
        protocol.tasks.push_back({ file.name, reference_state(file.path), [file, &options](const AskForMemory& ask) {
                                      return half_split(file, options, ask);
                                  } });
    return protocol;
}

} // namespace srisp::tool
