// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <vector>

#include "base/parallel.h"
#include "jpeg/jpeg_data.h"
#include "reference/decoders.h"
#include "reference/dng_curves.h"

namespace srisp {

namespace {

// As for LibRaw: tiny files that claim huge images must not take our memory.
constexpr std::uint64_t kMostBytes = std::uint64_t(1) << 30;

using LinearTable = std::array<std::uint16_t, 256>;

/// What each stored value stands for; values beyond the end of the file's table are its last entry.
LinearTable linear_table(const std::vector<std::uint16_t>& linearization)
{
    LinearTable table;
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = linearization.empty() ? std::uint16_t(i) : linearization[std::min(i, linearization.size() - 1)];
    return table;
}

/// Decodes one strip or tile into the stored image.
Status decode_block(const FileBytes& file, const DngDescription& dng, std::size_t index, const LinearTable& table,
                    std::uint16_t* image)
{
    const LossyDngData& lossy = *dng.lossy;
    const LossyDngData::Block& block = lossy.blocks[index];
    const std::size_t across = std::size_t((dng.stored_width - 1) / lossy.block_width + 1);
    const int x = int(index % across) * lossy.block_width, y = int(index / across) * lossy.block_height;
    // Blocks may reach beyond the image, or be cut where it ends.
    const int columns = std::min(lossy.block_width, dng.stored_width - x);
    const int rows = std::min(lossy.block_height, dng.stored_height - y);
    const unsigned char* data = file.data.get() + block.offset;
    const auto header = jpeg_header(data, block.size);
    const std::string where = " at x " + std::to_string(x) + ", y " + std::to_string(y);
    if (!header || !header->lossy() || header->bits != 8)
        return Error{ "damaged lossy DNG: no lossy JPEG of 8 bits" + where };
    if (header->components != dng.samples || header->width < columns || header->width > lossy.block_width ||
        header->height < rows || header->height > lossy.block_height)
        return Error{ "lossy DNG whose JPEG" + where + " has " + std::to_string(header->width) + " x " +
                      std::to_string(header->height) + " pixels of " + std::to_string(header->components) +
                      " samples where its tags say " + std::to_string(lossy.block_width) + " x " +
                      std::to_string(lossy.block_height) + " of " + std::to_string(dng.samples) };
    const auto pixels = decode_jpeg(data, block.size, *header);
    if (!pixels)
        return Error{ "damaged lossy DNG, JPEG" + where + ": " + pixels.error().message };
    const std::size_t samples = std::size_t(dng.samples);
    for (int row = 0; row < rows; ++row) {
        const unsigned char* source = pixels->data() + std::size_t(row) * std::size_t(header->width) * samples;
        std::uint16_t* target =
            image + (std::size_t(y + row) * std::size_t(dng.stored_width) + std::size_t(x)) * samples;
        for (std::size_t i = 0; i < std::size_t(columns) * samples; ++i)
            target[i] = table[source[i]];
    }
    return {};
}

/// Replaces the active area by what the curves make of it: values in [0,1].
void apply_curves(const DngCurves& curves, RawPixels& pixels)
{
    const std::size_t row_values = std::size_t(pixels.width) * std::size_t(pixels.channels);
    const std::shared_ptr<float[]> linear(new float[row_values * std::size_t(pixels.height)]);
    const RowScaler scaler(pixels);
    parallel_tasks(pixels.height, 0, [&](std::int64_t y) {
        float* row = linear.get() + std::size_t(y) * row_values;
        scaler.scale(int(y), row);
        curves.apply(int(y), pixels.width, pixels.channels, row);
    });
    pixels.owner = linear;
    pixels.shorts = nullptr;
    pixels.floats = linear.get();
    pixels.row_stride = std::ptrdiff_t(row_values);
    pixels.pixel_stride = pixels.channels;
    pixels.black = { 1, 1, std::vector<float>(std::size_t(pixels.channels)), {}, {} };
    pixels.white.fill(1);
}

} // namespace

Expected<RawImage> decode_lossy_dng(const FileBytes& file, const DngDescription& dng)
{
    const std::uint64_t values =
        std::uint64_t(dng.stored_width) * std::uint64_t(dng.stored_height) * std::uint64_t(dng.samples);
    const std::uint64_t block_values =
        std::uint64_t(dng.lossy->block_width) * std::uint64_t(dng.lossy->block_height) * std::uint64_t(dng.samples);
    if (std::max(values, block_values) * sizeof(float) > kMostBytes)
        return Error{ "lossy DNG of " + std::to_string(std::max(values, block_values)) + " values, the limit is " +
                      std::to_string(kMostBytes / sizeof(float)) };
    if (std::min(dng.layout.width, dng.layout.height) < 2)
        return Error{ "lossy DNG with an active area under 2 x 2 pixels" };
    const LinearTable table = linear_table(dng.lossy->linearization);
    const std::shared_ptr<std::uint16_t[]> image(new std::uint16_t[std::size_t(values)]);
    std::vector<Status> blocks(dng.lossy->blocks.size());
    parallel_tasks(std::int64_t(blocks.size()), 0, [&](std::int64_t i) {
        blocks[std::size_t(i)] = decode_block(file, dng, std::size_t(i), table, image.get());
    });
    for (const Status& block : blocks)
        if (!block)
            return block.error();

    RawImage result{ dng.layout, dng.facts, dng.notes, true };
    RawPixels& pixels = result.pixels;
    pixels.owner = image;
    pixels.pixel_stride = dng.samples;
    pixels.row_stride = std::ptrdiff_t(dng.stored_width) * dng.samples;
    pixels.shorts = image.get() + dng.top * pixels.row_stride + std::ptrdiff_t(dng.left) * dng.samples;
    const DngCurves curves(dng.lossy->opcodes);
    if (!curves.empty())
        apply_curves(curves, pixels);
    if (!curves.complete())
        result.notes.push_back("OpcodeList2 of the DNG has more than curves (gain maps and other corrections), which "
                               "was ignored");
    if (curves.empty() && dng.lossy->linearization.empty())
        result.notes.push_back("the lossy DNG states no curve: its values were taken as linear");
    return result;
}

} // namespace srisp
