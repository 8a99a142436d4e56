// SPDX-License-Identifier: Apache-2.0
#include "reference/dng_description.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/shown_text.h"
#include "camera/dng_camera.h"
#include "jpeg/jpeg_data.h"
#include "raw_file/tiff_numbers.h"
#include "raw_file/tiff_tags.h"
#include "reference/tiff_raw.h"

namespace srisp {

namespace {

using namespace tiff_tag;

constexpr int kJpeg = 7, kLossyJpeg = 34892; // compressions

/// One number is equal to itself, whatever it is.
bool all_equal(const std::vector<double>& values)
{
    return std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
}

/// Builds a description step by step; the first step that can't ends it.
class DngReader {
public:
    DngReader(const TiffTags& tags, const FileBytes& file) : m_tags(tags), m_file(file) {}

    Expected<DngDescription> read()
    {
        for (const auto step : { &DngReader::find_image, &DngReader::read_sizes, &DngReader::read_colors,
                                 &DngReader::read_black, &DngReader::read_white, &DngReader::check_storage })
            if (Status status = (this->*step)(); !status)
                return status.error();
        note_what_is_ignored();
        describe_levels(m_dng.layout, m_dng.facts);
        describe_dng_camera(m_tags, image(), m_dng.facts);
        return m_dng;
    }

private:
    const TiffFolder& image() const { return m_tags.folders()[m_image]; }
    int integer(std::uint16_t tag, int otherwise) const { return clamped(m_tags.value(image(), tag, otherwise)); }

    /// Damaged numbers must not overflow; everything real is far below this bound.
    static int clamped(double value) { return std::isnan(value) ? -1 : int(std::clamp(value, -1e9, 1e9)); }

    Status find_image();
    Status read_sizes();
    Status read_colors();
    Status read_black();
    Status read_white();
    Status check_storage();
    Status check_order(bool tiled, const std::vector<double>& offsets, const std::vector<double>& counts) const;
    Status find_lossy_data(bool tiled, const std::vector<double>& offsets, const std::vector<double>& counts);
    void note_what_is_ignored();

    const TiffTags& m_tags;
    const FileBytes& m_file;
    std::size_t m_image = 0; // among the folders
    DngDescription m_dng;
};

Status DngReader::find_image()
{
    const auto& folders = m_tags.folders();
    for (std::size_t i = 0; i < folders.size(); ++i) {
        const double photometric = m_tags.value(folders[i], kPhotometric, -1);
        const bool raw = photometric == kPhotometricCfa || photometric == kPhotometricLinearRaw;
        if (raw && m_tags.value(folders[i], kNewSubfileType, 0) == 0) {
            m_image = i;
            m_dng.folder_offset = folders[i].offset;
            return {};
        }
    }
    return Error{ "DNG without a main RAW image (photometric interpretation CFA or LinearRaw)" };
}

Status DngReader::read_sizes()
{
    m_dng.stored_width = integer(kImageWidth, 0);
    m_dng.stored_height = integer(kImageLength, 0);
    m_dng.samples = integer(kSamplesPerPixel, 1);
    m_dng.bits = integer(kBitsPerSample, 1);
    m_dng.is_float = integer(kSampleFormat, 1) == 3;
    m_dng.compression = integer(kCompression, 1);
    const std::string size = std::to_string(m_dng.stored_width) + " x " + std::to_string(m_dng.stored_height);
    if (std::min(m_dng.stored_width, m_dng.stored_height) < 1)
        return Error{ "DNG of " + size + " pixels: the image area is empty" };
    if (std::max(m_dng.stored_width, m_dng.stored_height) > kLargestDngSide)
        return Error{ "DNG of " + size + " pixels, the limit is " + std::to_string(kLargestDngSide) + " a side" };

    std::vector<double> area = m_tags.values(image(), kActiveArea); // top, left, bottom, right
    if (area.size() != 4)
        area = { 0, 0, double(m_dng.stored_height), double(m_dng.stored_width) };
    const int bottom = clamped(area[2]), right = clamped(area[3]);
    m_dng.top = clamped(area[0]);
    m_dng.left = clamped(area[1]);
    m_dng.layout.width = right - m_dng.left;
    m_dng.layout.height = bottom - m_dng.top;
    if (m_dng.top < 0 || m_dng.left < 0 || m_dng.layout.width < 1 || m_dng.layout.height < 1 ||
        bottom > m_dng.stored_height || right > m_dng.stored_width)
        return Error{ "DNG of " + size + " pixels whose active area (top " + std::to_string(m_dng.top) + ", left " +
                      std::to_string(m_dng.left) + ", bottom " + std::to_string(bottom) + ", right " +
                      std::to_string(right) + ") is empty or lies outside" };
    return {};
}

Status DngReader::read_colors()
{
    if (integer(kPhotometric, -1) == kPhotometricLinearRaw) {
        m_dng.layout.channels = m_dng.samples;
        if (m_dng.samples == 1)
            return Error{ "monochrome DNG (LinearRaw with one sample per pixel): a reference needs three colours" };
        if (m_dng.samples != 3)
            return Error{ "LinearRaw DNG with " + std::to_string(m_dng.samples) +
                          " samples per pixel: a reference needs three colours" };
        return {};
    }
    if (m_dng.samples != 1)
        return Error{ "DNG mosaic with " + std::to_string(m_dng.samples) + " samples per pixel: only 1 is supported" };
    if (integer(kCfaLayout, 1) != 1)
        return Error{ "DNG with a staggered mosaic (CFALayout " + std::to_string(integer(kCfaLayout, 1)) +
                      "): not supported" };
    const std::vector<double> dim = m_tags.values(image(), kCfaRepeatPatternDim),
                              pattern = m_tags.values(image(), kCfaPattern);
    CfaPattern& cfa = m_dng.layout.cfa;
    const bool bayer = pattern.size() == 4 && dim == std::vector<double>{ 2, 2 };
    const bool xtrans = pattern.size() == 36 && dim == std::vector<double>{ 6, 6 };
    if (!bayer && !xtrans)
        return Error{ "DNG mosaic of " + std::to_string(pattern.size()) +
                      " filters: only patterns of 2 x 2 and 6 x 6 are supported" };
    cfa.rows = cfa.columns = bayer ? 2 : 6;
    // CFAPattern holds colours (0 R, 1 G, 2 B, 3 … others); CFAPlaneColor only tells in which order planes come.
    for (const double color : pattern)
        cfa.letters += color >= 0 && color < 7 ? "RGBCMYW"[int(color)] : '?';
    return check_filters(m_dng.layout);
}

Status DngReader::read_black()
{
    BlackLevels& black = m_dng.layout.black;
    const std::vector<double> dim = m_tags.values(image(), kBlackLevelRepeatDim);
    std::vector<double> levels = m_tags.values(image(), kBlackLevel);
    if (dim.size() == 2) {
        black.rows = clamped(dim[0]);
        black.columns = clamped(dim[1]);
    } else if (m_dng.layout.channels == 1 && m_dng.layout.cfa.rows == 2 && levels.size() == 4 && !all_equal(levels)) {
        // Small writers forget the tag. dcraw takes the first of the four for all, LibRaw none of them.
        black.rows = black.columns = 2;
        m_dng.notes.push_back("the DNG states four black levels without a pattern: 2 x 2 was assumed");
    }
    if (std::min(black.rows, black.columns) < 1 || std::max(black.rows, black.columns) > kLargestBlackPattern)
        return Error{ "DNG black level pattern of " + std::to_string(black.rows) + " x " +
                      std::to_string(black.columns) + ": 1 to " + std::to_string(kLargestBlackPattern) +
                      " are possible" };
    const std::size_t expected =
        std::size_t(black.rows) * std::size_t(black.columns) * std::size_t(m_dng.layout.channels);
    if (levels.empty() || all_equal(levels)) // equal ones need no pattern; none means 0
        levels.assign(expected, levels.empty() ? 0 : levels[0]);
    if (levels.size() != expected)
        return Error{ "DNG with " + std::to_string(levels.size()) + " black levels where its pattern needs " +
                      std::to_string(expected) };
    black.pattern.assign(levels.begin(), levels.end());

    const std::vector<double> h = m_tags.values(image(), kBlackLevelDeltaH),
                              v = m_tags.values(image(), kBlackLevelDeltaV);
    if ((!h.empty() && h.size() != std::size_t(m_dng.layout.width)) ||
        (!v.empty() && v.size() != std::size_t(m_dng.layout.height)))
        return Error{ "DNG whose BlackLevelDeltaH (" + std::to_string(h.size()) + ") or BlackLevelDeltaV (" +
                      std::to_string(v.size()) + ") does not fit its active area" };
    black.by_column.assign(h.begin(), h.end());
    black.by_row.assign(v.begin(), v.end());
    return {};
}

Status DngReader::read_white()
{
    std::vector<double> levels = m_tags.values(image(), kWhiteLevel);
    if (levels.empty())
        levels = { m_dng.is_float ? 1.0 : std::exp2(std::clamp(m_dng.bits, 1, 32)) - 1 };
    const std::vector<double> table = m_tags.values(image(), kLinearizationTable);
    if (image().find(kWhiteLevel) == nullptr && !table.empty())
        levels = { *std::max_element(table.begin(), table.end()) };
    for (int c = 0; c < 3; ++c)
        m_dng.layout.white[std::size_t(c)] = float(levels[std::min(std::size_t(c), levels.size() - 1)]);
    return check_levels(m_dng.layout);
}

/// Whether all image data lie in the file, in a form that one of the decoders really handles.
Status DngReader::check_storage()
{
    if (m_dng.compression == 9)
        return Error{ undecoded_vc5() };
    if (m_dng.compression == 52546)
        return Error{ "DNG compressed by JPEG XL: not supported; convert it to a DNG without it" };
    if (integer(kPlanarConfiguration, 1) != 1)
        return Error{ "DNG with separate colour planes: not supported" };
    const bool tiled = image().find(kTileOffsets) != nullptr;
    const std::vector<double> offsets = m_tags.values(image(), tiled ? kTileOffsets : kStripOffsets);
    const std::vector<double> counts = m_tags.values(image(), tiled ? kTileByteCounts : kStripByteCounts);
    if (offsets.empty() || offsets.size() != counts.size())
        return Error{ "DNG without image data" };
    double all = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        all += counts[i];
        if (!(offsets[i] >= 0 && counts[i] >= 0))
            return Error{ "DNG with image data at byte " + shown_number(offsets[i]) + ", " + shown_number(counts[i]) +
                          " bytes long" };
        if (offsets[i] + counts[i] > double(m_file.size))
            return Error{ "truncated: image data end at byte " + std::to_string(whole_number(offsets[i] + counts[i])) +
                          ", the file has " + std::to_string(m_file.size) };
    }
    if (all > double(m_file.size)) // a million tiles of the same bytes take hours
        return Error{ "DNG whose tiles or strips overlap: they have " + shown_number(all) + " bytes, the file " +
                      std::to_string(m_file.size) };
    if (m_dng.is_float)
        return {}; // libtiff decodes these
    const auto jpeg = jpeg_header(m_file.data.get() + std::size_t(offsets[0]), std::size_t(counts[0]));
    if (m_dng.compression == kLossyJpeg && !jpeg)
        return Error{ "damaged lossy DNG: its image data do not begin with a JPEG" };
    if (m_dng.compression == kLossyJpeg && (!jpeg->lossy() || jpeg->bits != 8))
        return Error{ "lossy DNG whose JPEGs have process " + std::to_string(jpeg->process) + " and " +
                      std::to_string(jpeg->bits) + " bits: only lossy ones of 8 bits are supported" };
    const bool is_jpeg = m_dng.compression == kJpeg || m_dng.compression == kLossyJpeg;
    return is_jpeg && jpeg && jpeg->lossy() && jpeg->bits == 8 ? find_lossy_data(tiled, offsets, counts)
                                                               : check_order(tiled, offsets, counts);
}

/// LibRaw reads uncompressed data in one run and the first strip only of a JPEG, whatever the tags say.
Status DngReader::check_order(bool tiled, const std::vector<double>& offsets, const std::vector<double>& counts) const
{
    if (m_dng.compression != 1 && m_dng.compression != kJpeg)
        return Error{ "DNG of integers with compression " + std::to_string(m_dng.compression) +
                      ": LibRaw does not decode it" };
    if (m_dng.compression == kJpeg && !tiled && offsets.size() != 1)
        return Error{ "DNG with several JPEG strips: LibRaw does not decode it" };
    if (m_dng.compression == kJpeg)
        return {};
    if (tiled && integer(kTileWidth, 0) != m_dng.stored_width)
        return Error{ "uncompressed DNG in tiles: LibRaw does not decode it" };
    for (std::size_t i = 1; i < offsets.size(); ++i)
        if (offsets[i] != offsets[i - 1] + counts[i - 1])
            return Error{ "uncompressed DNG whose strips do not follow each other: LibRaw does not decode it" };
    return {};
}

Status DngReader::find_lossy_data(bool tiled, const std::vector<double>& offsets, const std::vector<double>& counts)
{
    LossyDngData data;
    data.block_width = tiled ? integer(kTileWidth, 0) : m_dng.stored_width;
    data.block_height =
        tiled ? integer(kTileLength, 0) : std::min(integer(kRowsPerStrip, m_dng.stored_height), m_dng.stored_height);
    const std::string size = std::to_string(data.block_width) + " x " + std::to_string(data.block_height);
    if (std::min(data.block_width, data.block_height) < 1 ||
        std::max(data.block_width, data.block_height) > kLargestDngSide)
        return Error{ "lossy DNG with tiles or strips of " + size + " pixels: from 1 to " +
                      std::to_string(kLargestDngSide) + " a side are possible" };
    const std::size_t columns = std::size_t((m_dng.stored_width - 1) / data.block_width + 1);
    const std::size_t rows = std::size_t((m_dng.stored_height - 1) / data.block_height + 1);
    if (offsets.size() < columns * rows)
        return Error{ "lossy DNG with " + std::to_string(offsets.size()) + " tiles or strips of " + size +
                      " pixels where it needs " + std::to_string(columns * rows) };
    for (std::size_t i = 0; i < columns * rows; ++i)
        data.blocks.push_back({ std::size_t(offsets[i]), std::size_t(counts[i]) });
    for (const double value : m_tags.values(image(), kLinearizationTable))
        data.linearization.push_back(std::uint16_t(std::min<std::uint64_t>(whole_number(value), 65535)));
    data.opcodes = m_tags.bytes(image(), kOpcodeList2);
    m_dng.lossy = std::move(data);
    return {};
}

void DngReader::note_what_is_ignored()
{
    for (const std::uint16_t list : { kOpcodeList1, kOpcodeList2, kOpcodeList3 })
        if (image().find(list) && !(m_dng.lossy && list == kOpcodeList2)) // a lossy one's decoder looks into it
            m_dng.notes.push_back("OpcodeList" + std::to_string(list == kOpcodeList3 ? 3 : list - kOpcodeList1 + 1) +
                                  " of the DNG (gain maps and other corrections) was ignored");
    if (image().find(kBlackLevel) == nullptr)
        m_dng.notes.push_back("the DNG states no black level: 0 was assumed");
    if (image().find(kWhiteLevel) == nullptr)
        m_dng.notes.push_back("the DNG states no white level: the largest value that it can hold was assumed");
}

} // namespace

Expected<std::optional<DngDescription>> describe_dng(const FileBytes& file)
{
    const TiffTags tags(file.data.get(), file.size);
    if (tags.folders().empty() || tags.folders()[0].find(kDngVersion) == nullptr)
        return std::optional<DngDescription>();
    auto description = DngReader(tags, file).read();
    if (!description)
        return description.error();
    return std::optional<DngDescription>(std::move(*description));
}

} // namespace srisp
