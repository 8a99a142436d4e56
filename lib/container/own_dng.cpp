// SPDX-License-Identifier: Apache-2.0
#include "container/own_dng.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <OpenImageIO/strutil.h>
#include <srisp/metadata.h>

#include "base/file_bytes.h"
#include "base/recently_kept.h"
#include "camera/dng_camera.h"
#include "container/file_description.h"
#include "raw_file/tiff_numbers.h"
#include "raw_file/tiff_tags.h"
#include "record/record.h"

namespace srisp {

namespace {

using namespace tiff_tag;
constexpr int kPlaces = 4; // R, G, B, second G

const TiffFolder* main_image(const TiffTags& tags)
{
    for (const TiffFolder& folder : tags.folders()) {
        const double photometric = tags.value(folder, kPhotometric, -1);
        if ((photometric == kPhotometricCfa || photometric == kPhotometricLinearRaw) &&
            tags.value(folder, kNewSubfileType, 0) == 0)
            return &folder;
    }
    return nullptr;
}

/// The filters over the first two pixels of the first two rows, which repeat; empty for three channels.
std::optional<std::string> read_filters(const TiffTags& tags, const TiffFolder& image)
{
    std::string letters;
    if (tags.value(image, kPhotometric, 0) == kPhotometricLinearRaw)
        return letters;
    for (const double color : tags.values(image, kCfaPattern))
        letters += color == 0 ? 'R' : color == 1 ? 'G' : 'B';
    static const char* const kPhases[] = { "RGGB", "GRBG", "GBRG", "BGGR" };
    if (std::find(std::begin(kPhases), std::end(kPhases), letters) == std::end(kPhases))
        return {};
    return letters;
}

/// Which of R, G, B and second G a sample has: of a mosaic by its row and column, else by its plane.
std::size_t place_of(const std::string& filters, std::size_t row, std::size_t column, std::size_t plane)
{
    if (filters.empty())
        return plane;
    const char letter = filters[row % 2 * 2 + column % 2];
    return letter == 'R' ? 0 : letter == 'B' ? 2 : row % 2 == 0 ? 1 : 3;
}

/// Sets the levels in the facts, and gives the four ranges; none that are all above 0: nothing.
std::optional<std::array<float, 4>> read_levels(const TiffTags& tags, const TiffFolder& image, CameraFacts& facts)
{
    const std::size_t planes = facts.cfa_pattern.empty() ? 3 : 1;
    std::vector<double> white = tags.values(image, kWhiteLevel), black = tags.values(image, kBlackLevel);
    std::vector<double> dim = tags.values(image, kBlackLevelRepeatDim);
    if (dim.size() != 2)
        dim = { 1, 1 };
    for (const double side : dim)
        if (!(side >= 1 && side <= kLargestBlackPattern))
            return {};
    const std::size_t rows = std::size_t(dim[0]), columns = std::size_t(dim[1]);
    if (black.empty())
        black.assign(rows * columns * planes, 0.0);
    if (white.empty() || black.size() != rows * columns * planes)
        return {};

    std::array<double, kPlaces> sums{}, counts{};
    for (std::size_t row = 0; row < 2 * rows; ++row) // over a common period of both patterns
        for (std::size_t column = 0; column < 2 * columns; ++column)
            for (std::size_t plane = 0; plane < planes; ++plane) {
                const std::size_t place = place_of(facts.cfa_pattern, row, column, plane);
                sums[place] += black[(row % rows * columns + column % columns) * planes + plane];
                counts[place] += 1;
            }
    std::array<float, kPlaces> ranges{};
    for (std::size_t place = 0; place < kPlaces; ++place) {
        const std::size_t from = counts[place] > 0 ? place : 1; // three planes have one G
        facts.black_level[place] = float(sums[from] / counts[from]);
        ranges[place] = float(white[std::min(place == 3 ? 1 : place, white.size() - 1)]) - facts.black_level[place];
        if (!(ranges[place] > 0))
            return {};
    }
    facts.white_level = float(white[0]);
    if (facts.cfa_pattern.find('B') < facts.cfa_pattern.find('R')) // the first G is in a row of B
        std::swap(ranges[1], ranges[3]);
    return ranges;
}

/// By the first folder of its tags, which srisp, and most programs, write first.
bool may_be_dng(const std::string& path, bool named_raw)
{
    constexpr std::size_t kLook = std::size_t(64) << 10;
    const auto head = read_head(path, kLook);
    if (!head)
        return false;
    const TiffTags tags(reinterpret_cast<const unsigned char*>(head->data()), head->size());
    if (tags.folders().empty())
        return false;
    const TiffFolder& first = tags.folders()[0];
    return first.find(kDngVersion) || (first.tags.empty() && named_raw);
}

std::shared_ptr<const OwnDng> read_own_dng(const FileBytes& file)
{
    const TiffTags tags(file.data.get(), file.size);
    if (tags.folders().empty() || !tags.folders()[0].find(kDngVersion))
        return nullptr;
    auto dng = std::make_shared<OwnDng>();
    dng->description = tags.text(tags.folders()[0], kImageDescription);
    const auto record = find_record(dng->description);
    const TiffFolder* const image = main_image(tags);
    if (!record || record->direction != Direction::reverse || !image)
        return nullptr;
    const auto filters = read_filters(tags, *image);
    if (!filters)
        return nullptr;
    dng->facts.cfa_pattern = *filters;
    const auto ranges = read_levels(tags, *image, dng->facts);
    if (!ranges)
        return nullptr;
    dng->ranges = *ranges;
    describe_dng_camera(tags, *image, dng->facts);
    return dng;
}

} // namespace

std::shared_ptr<const OwnDng> find_own_dng(const std::string& path, bool named_raw)
{
    if (!may_be_dng(path, named_raw))
        return nullptr;
    constexpr std::size_t kMostKept = 64; // a photo is opened several times
    using Found = std::shared_ptr<const std::shared_ptr<const OwnDng>>;
    static auto& found = *new RecentlyKept<Found>(kMostKept);
    const auto dng = found.get(file_state(path), [&]() -> Expected<Found> {
        const auto file = read_whole_file(path);
        if (!file)
            return file.error();
        return std::make_shared<const std::shared_ptr<const OwnDng>>(read_own_dng(*file));
    });
    return dng ? **dng : nullptr;
}

void ask_for_camera_rgb(const OwnDng& dng, OIIO::ImageSpec& hints)
{
    auto& all = hints.extra_attribs;
    all.erase(std::remove_if(all.begin(), all.end(),
                             [](const auto& hint) { return OIIO::Strutil::istarts_with(hint.name(), "raw:"); }),
              all.end());
    hints.attribute("raw:ColorSpace", "raw");
    hints.attribute("raw:use_camera_wb", 0);
    hints.attribute("raw:use_camera_matrix", 0);
    hints.attribute("raw:user_flip", 0);
    // LibRaw scales all by one range, that of user_sat, and by a number for each filter over the smallest of these.
    const float widest = *std::max_element(dng.ranges.begin(), dng.ranges.end());
    std::array<float, kPlaces> scales{};
    for (std::size_t i = 0; i < scales.size(); ++i)
        scales[i] = widest / dng.ranges[i];
    hints.attribute("raw:user_sat", int(std::lround(widest)));
    hints.attribute("raw:user_mul", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, kPlaces), scales.data());
}

void describe_own_dng(const OwnDng& dng, OIIO::ImageSpec& spec)
{
    spec.attribute("ImageDescription", dng.description);
    spec.attribute("Orientation", dng.facts.orientation);
    CameraFacts facts = dng.facts;
    if (facts.as_shot_neutral[1] > 0)
        spec.attribute(attribute::kNeutral, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 3), facts.as_shot_neutral.data());
    facts.as_shot_neutral = {}; // what follows is of the reference, not of the scene
    facts.noise_profile.clear();
    write_camera(spec, facts);
    set_color_space(spec, kCameraColorSpace);
}

} // namespace srisp
