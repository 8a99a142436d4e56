// SPDX-License-Identifier: Apache-2.0
#include "bake_choice.h"

#include <algorithm>
#include <filesystem>
#include <future>

#include <srisp/neutral_rendition.h>
#include <srisp/select.h>
#include <srisp/thumbnail.h>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "base/input_file.h"
#include "base/json_text.h"
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
    PhotoSample sample{ name, width, height, {}, {}, {} };
    for (int row = 0; row < kTilesPerSide; ++row)
        for (int column = 0; column < kTilesPerSide; ++column) {
            Roi roi;
            middle_of_share(width, column, roi.x0, roi.x1);
            middle_of_share(height, row, roi.y0, roi.y1);
            if (roi.x0 != roi.x1 && roi.y0 != roi.y1) // else fewer pixels than parts
                sample.tiles.push_back({ roi, {} });
        }
    return sample;
}

/// `rows`: rows y0 and below of the whole width.
void add_rows(PhotoSample& sample, ImageView rows, int y0)
{
    for (PhotoSample::Tile& tile : sample.tiles)
        for (int y = std::max(y0, tile.roi.y0); y < std::min(y0 + rows.height, tile.roi.y1); ++y)
            tile.rgb.insert(tile.rgb.end(), rows.pixel(tile.roi.x0, y - y0), rows.pixel(tile.roi.x1, y - y0));
}

} // namespace

PhotoSample read_photo_sample(const std::string& path, bool allow_partial)
{
    Options options;
    options.allow_partial = allow_partial;
    PhotoFile photo = require(PhotoFile::open(path, options));
    PhotoSample sample = empty_sample(path, photo.width(), photo.height());
    ThumbnailBuilder builder(sample.width, sample.height);
    PhotoReader reader = photo.reader();
    require(reader.read_all([&](ImageView rows, int y0) {
        check_interrupt();
        builder.add_rows(rows);
        add_rows(sample, rows, y0);
        return Status();
    }));
    sample.thumbnail = builder.finish(photo.orientation());
    sample.notes = photo.notes(reader.counts());
    return sample;
}

PhotoSample sample_of_thumbnail(const Thumbnail& picture, const std::string& name)
{
    PhotoSample sample = empty_sample(name, kThumbnailSize, kThumbnailSize);
    add_rows(sample, picture.view(), 0);
    sample.thumbnail = picture;
    return sample;
}

namespace {

std::shared_ptr<const Model> bakeable_model(const std::string& name)
{
    auto model = require(Model::load(name));
    if (model->kernel_size() != 1)
        fail("model '" + name + "' looks at " + std::to_string(model->kernel_size()) + " x " +
             std::to_string(model->kernel_size()) +
             " pixels, and a colour transform sees one: needs a model with kernel size 1, such as 'default'");
    return model;
}

Parameters given_parameters(const std::string& path, const Model& model, const std::string& model_name)
{
    const auto text = read_text_file(path, kLargestJson);
    if (!text)
        fail("parameters " + text.error().message);
    const Parameters parameters = require(parameters_from_json(*text, "'" + path + "'"));
    if (const Status fits = check_parameters(parameters, model); !fits)
        fail("parameters '" + path + "': " + fits.error().message +
             " (srisptool PHOTO --srisp-params:model=" + model_name + " REFERENCE prints such)");
    return parameters;
}

Parameters chosen_parameters(const Model& model, const Thumbnail& photo, const Reference& reference,
                             std::vector<std::string>* notes)
{
    Parameters parameters = require(select(model, photo, reference.thumbnail, notes));
    parameters.reference_name = reference.name;
    parameters.reference_hash = reference.hash;
    return parameters;
}

void make_brighter(BakeChoice& choice, const BakeOptions& options)
{
    Parameters& parameters = choice.parameters;
    if (!options.parameters.empty())
        if (const std::string note = brightness_note(parameters); !note.empty())
            choice.notes.push_back(note);
    if (options.brightness.empty())
        return;
    Options parsed;
    require(set_option(parsed, "brightness", options.brightness));
    const std::string photo = options.source.empty() ? options.reference : options.source;
    require(choose_brightness(parameters, *parsed.brightness, options.seed,
                              std::filesystem::path(photo).filename().string(), &choice.notes));
}

/// By the reference's camera; white is that of the scene.
void choose_development(BakeChoice& choice, const BakeOptions& options)
{
    DevelopSource source{};
    source.parameters = &choice.parameters;
    if (choice.reference) {
        source.camera = choice.reference->facts;
        source.reference_neutral = source.camera.as_shot_neutral;
    }
    source.camera.as_shot_neutral = {}; // that of the parameters
    choice.development = require(srisp::choose_development(source, development_options(options), choice.notes));
}

} // namespace

BakeChoice make_choice(const BakeOptions& options)
{
    BakeChoice choice;
    choice.model = bakeable_model(options.model);
    if (!options.parameters.empty())
        choice.parameters = given_parameters(options.parameters, *choice.model, options.model);
    auto reference = std::async(std::launch::async, [&] {
        return options.reference.empty() ? Expected<std::shared_ptr<const Reference>>(nullptr)
                                         : load_reference(options.reference);
    });
    if (!options.source.empty())
        choice.photo = read_photo_sample(options.source, options.allow_partial);
    choice.reference = require(reference.get());
    check_interrupt();
    if (!choice.reference) {
        make_brighter(choice, options);
        choose_development(choice, options);
        return choice;
    }
    choice.notes = choice.reference->notes;
    if (!choice.photo)
        choice.photo = sample_of_thumbnail(neutral_rendition(*choice.reference), "the reference's neutral rendition");
    if (options.parameters.empty())
        choice.parameters = chosen_parameters(*choice.model, choice.photo->thumbnail, *choice.reference, &choice.notes);
    make_brighter(choice, options);
    choose_development(choice, options);
    return choice;
}

} // namespace srisp::tool
