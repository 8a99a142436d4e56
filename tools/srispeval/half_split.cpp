// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <memory>

#include "../common/failure.h"
#include "packed_raws.h"
#include "photo_rendering.h"
#include "protocol.h"

namespace srisp::tool {

namespace {

constexpr int kQuarterTurn = 6; // EXIF orientation
constexpr int kLeastSide = 32;  // pixels

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

/// The two tests of a picture in one rendering, or why there are none.
void add_rendering(const RawPicture& upright, const std::string& name, const Expected<Pixels>& photo,
                   const std::string& file, TestImages& result)
{
    if (!photo) {
        result.left_out.push_back({ file, name + ": " + photo.error().message });
        return;
    }
    const bool turn = upright.pixels.height > upright.pixels.width;
    RawPicture raw = upright;
    if (turn)
        raw.pixels = oriented(std::move(raw.pixels), kQuarterTurn);
    ImageScore score;
    score.image = file;
    score.camera = raw.camera;
    score.reference = "left half";
    score.rendering = name;
    score.notes = raw.notes;
    const Pixels reference = raw.pixels.part({ 0, raw.pixels.width / 2, 0, raw.pixels.height });
    add_halves(raw, reference, turn ? oriented(*photo, kQuarterTurn) : *photo, score, result.images);
}

Expected<TestImages> split_file(const ListedFile& file, const EvalOptions& options, const AskForMemory& ask)
{
    const auto raw = load_raw_picture(file.path, options.size, ask);
    if (!raw)
        return raw.error();
    if (std::min(raw->pixels.width, raw->pixels.height) < kLeastSide)
        return Error{ "has " + std::to_string(raw->pixels.width) + " x " + std::to_string(raw->pixels.height) +
                      " pixels; the least that can be split is " + std::to_string(kLeastSide) + " a side" };
    TestImages result;
    for (const std::string& name : options.renderings)
        add_rendering(*raw, name, photo_of_raw(rendering_kind(name), file.path, *raw, file.name, options.seed),
                      file.name, result);
    return result;
}

Expected<TestImages> split_packed(const TrainingPack& pack, std::size_t entry, const EvalOptions& options)
{
    const std::string& file = pack.raws().entries[entry].name;
    TestImages result;
    for (const std::string& name : options.renderings) {
        const auto raw = packed_raw_picture(pack, entry, name == "camera", options.seed);
        if (!raw)
            return raw.error();
        if (is_our_own(rendering_kind(name)))
            add_rendering(*raw, name, photo_of_raw(rendering_kind(name), "", *raw, file, options.seed), file, result);
    }
    return result;
}

void add_pack(const std::string& folder, const EvalOptions& options, Protocol& protocol)
{
    const std::shared_ptr<const TrainingPack> pack = require(TrainingPack::open(folder));
    const std::size_t before = protocol.tasks.size();
    for (const std::size_t entry : packed_test_images(*pack))
        protocol.tasks.push_back(
            { pack->raws().entries[entry].name, pack->hash() + " " + std::to_string(entry), std::vector<std::string>(),
              [pack, entry, &options](const AskForMemory&) { return split_packed(*pack, entry, options); } });
    if (protocol.tasks.size() == before)
        fail("pack '" + folder + "' has no RAW images for validation");
    protocol.text.push_back("RAW images of packs, squares without their exposure, get one at random: the 98th "
                            "percentile of the largest channel lies at 0.03 to 1.25, for the rendering \"camera\" at "
                            "0.15 to 1.25. Only those for validation are tested.");
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
    std::vector<std::string> words;
    for (const std::string& word : options.inputs) {
        std::error_code error;
        if (std::filesystem::exists(std::filesystem::path(word) / "pack.json", error))
            add_pack(word, options, protocol);
        else
            words.push_back(word);
    }
    for (const ListedFile& file : words.empty() ? std::vector<ListedFile>() : list_raw_files(words))
        protocol.tasks.push_back(
            { file.name, reference_state(file.path), { file.path }, [file, &options](const AskForMemory& ask) {
                 return split_file(file, options, ask);
             } });
    return protocol;
}

} // namespace srisp::tool
