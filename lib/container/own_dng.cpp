// SPDX-License-Identifier: Apache-2.0
#include "container/own_dng.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/file_bytes.h"
#include "base/recently_kept.h"
#include "base/shown_text.h"
#include "camera/dng_camera.h"
#include "raw_file/dng_head.h"
#include "raw_file/tiff_numbers.h"
#include "raw_file/tiff_tags.h"
#include "record/record.h"

namespace srisp {

namespace {

using namespace tiff_tag;
constexpr std::size_t kPlaces = 4; // R, G, B, second G
constexpr double kMostCode = 65535;

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

/// Whether the filters are those of a Bayer mosaic, or there are none as three channels need none.
bool read_filters(const TiffTags& tags, const TiffFolder& image, CameraFacts& facts)
{
    if (tags.value(image, kPhotometric, 0) == kPhotometricLinearRaw)
        return true;
    for (const double color : tags.values(image, kCfaPattern))
        facts.cfa_pattern += color == 0 ? 'R' : color == 1 ? 'G' : 'B';
    static const char* const kPhases[] = { "RGGB", "GRBG", "GBRG", "BGGR" };
    return std::find(std::begin(kPhases), std::end(kPhases), facts.cfa_pattern) != std::end(kPhases);
}

/// Which of R, G, B and second G a sample has: of a mosaic by its row and column, else by its plane.
std::size_t place_of(const std::string& filters, std::size_t row, std::size_t column, std::size_t plane)
{
    if (filters.empty())
        return plane;
    const char letter = filters[row % 2 * 2 + column % 2];
    return letter == 'R' ? 0 : letter == 'B' ? 2 : row % 2 == 0 ? 1 : 3;
}

/// How often black levels repeat: rows, columns; 0: that cannot be.
std::array<std::size_t, 2> black_pattern(const TiffTags& tags, const TiffFolder& image)
{
    std::vector<double> dim = tags.values(image, kBlackLevelRepeatDim);
    if (dim.size() != 2)
        dim = { 1, 1 };
    const auto possible = [](double side) { return side >= 1 && side <= kLargestBlackPattern; };
    if (!possible(dim[0]) || !possible(dim[1]))
        return { 0, 0 };
    return { std::size_t(dim[0]), std::size_t(dim[1]) };
}

/// Whether white is above black everywhere, and LibRaw can take the numbers; floats: whether they are 0 and 1.
bool read_levels(const TiffTags& tags, const TiffFolder& image, OwnDng& dng)
{
    const std::string& filters = dng.facts.cfa_pattern;
    const std::size_t planes = filters.empty() ? 3 : 1;
    const auto [rows, columns] = black_pattern(tags, image);
    const std::vector<double> white = tags.values(image, kWhiteLevel), black = tags.values(image, kBlackLevel);
    if (white.empty() || rows == 0 || black.size() != rows * columns * planes)
        return false;

    std::array<double, kPlaces> sums{}, counts{};
    for (std::size_t row = 0; row < 2 * rows; ++row) // over a common period of both patterns
        for (std::size_t column = 0; column < 2 * columns; ++column)
            for (std::size_t plane = 0; plane < planes; ++plane) {
                const std::size_t place = place_of(filters, row, column, plane);
                sums[place] += black[(row % rows * columns + column % columns) * planes + plane];
                counts[place] += 1;
            }
    for (std::size_t place = 0; place < kPlaces; ++place) {
        const std::size_t from = counts[place] > 0 ? place : 1; // three planes have one G
        const double its_white = white[std::min(place == 3 ? 1 : place, white.size() - 1)];
        const double its_black = sums[from] / counts[from];
        const bool usable = dng.is_float ? its_black == 0 && its_white == 1
                                         : its_black >= 0 && its_black < its_white && its_white <= kMostCode;
        if (!usable)
            return false;
        dng.facts.black_level[place] = float(its_black);
        dng.ranges[place] = float(its_white - its_black);
    }
    dng.facts.white_level = float(white[0]);
    if (filters.find('B') < filters.find('R')) // the first G is in a row of B
        std::swap(dng.ranges[1], dng.ranges[3]);
    return true;
}

/// What its image data miss, which LibRaw would not say; empty: nothing.
std::string find_truncation(const TiffTags& tags, const TiffFolder& image, std::size_t file_size)
{
    const bool tiled = image.find(kTileOffsets) != nullptr;
    const std::vector<double> offsets = tags.values(image, tiled ? kTileOffsets : kStripOffsets);
    const std::vector<double> counts = tags.values(image, tiled ? kTileByteCounts : kStripByteCounts);
    double end = 0;
    for (std::size_t i = 0; i < std::min(offsets.size(), counts.size()); ++i)
        end = std::max(end, offsets[i] + counts[i]);
    if (end <= double(file_size))
        return "";
    return "truncated: image data end at byte " + std::to_string(whole_number(end)) + ", the file has " +
           std::to_string(file_size);
}

using Found = std::shared_ptr<const OwnDng>;

Expected<Found> read_own_dng(const FileBytes& file)
{
    const TiffTags tags(file.data.get(), file.size);
    if (tags.folders().empty() || !tags.folders()[0].find(kDngVersion))
        return Found();
    const auto dng = std::make_shared<OwnDng>();
    dng->description = tags.text(tags.folders()[0], kImageDescription);
    const auto record = find_record(dng->description);
    if (!record || record->direction != Direction::reverse)
        return Found();
    const TiffFolder* const image = main_image(tags);
    if (!image)
        return Error{ "is a DNG without a main RAW image" };
    dng->image_folder = image->offset;
    dng->is_float = tags.value(*image, kSampleFormat, 1) == 3;
    if (!read_filters(tags, *image, dng->facts) || !read_levels(tags, *image, *dng))
        return Error{ "is a DNG that srisp wrote, with filters or levels that its readers cannot use" };
    describe_dng_camera(tags, *image, dng->facts);
    dng->truncation = find_truncation(tags, *image, file.size);
    const double width = tags.value(*image, kImageWidth, 0), height = tags.value(*image, kImageLength, 0);
    if (!dng->is_float && std::min(width, height) < kSmallestLibrawSide)
        return Error{ "is a DNG of " + shown_number(width) + " x " + shown_number(height) +
                      " pixels: LibRaw, which reads it, needs " + std::to_string(kSmallestLibrawSide) + " a side" };
    return Found(dng);
}

} // namespace

Expected<Found> find_own_dng(const std::string& path, bool named_raw)
{
    const DngHead head = dng_head(path);
    if (head == DngHead::no || (head == DngHead::unknown && !named_raw))
        return Found();
    constexpr std::size_t kMostKept = 64; // a photo is opened several times
    static auto& kept = *new RecentlyKept<std::shared_ptr<const Found>>(kMostKept);
    const auto found = kept.get(file_state(path), [&]() -> Expected<std::shared_ptr<const Found>> {
        const auto file = read_whole_file(path);
        if (!file)
            return file.error();
        auto dng = read_own_dng(*file);
        if (!dng)
            return dng.error();
        return std::make_shared<const Found>(std::move(*dng));
    });
    return found ? Expected<Found>(**found) : found.error();
}

} // namespace srisp
