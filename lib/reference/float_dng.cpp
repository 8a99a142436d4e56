// SPDX-License-Identifier: Apache-2.0
#include "reference/decoders.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include <tiffio.h>

#include "base/half_float.h"

namespace srisp {

namespace {

// As for LibRaw: tiny files that claim huge images must not take our memory.
constexpr std::uint64_t kMostBytes = std::uint64_t(1) << 30;
constexpr std::uint64_t kMostBlocks = std::uint64_t(1) << 20;

/// What libtiff reads: a file in memory; and what it complained about.
struct MemoryFile {
    const FileBytes& bytes;
    std::uint64_t position = 0;
    std::string complaint;
};

tmsize_t read_memory(thandle_t handle, void* target, tmsize_t size)
{
    MemoryFile& file = *static_cast<MemoryFile*>(handle);
    const std::uint64_t count = std::min(file.bytes.size - file.position, std::uint64_t(std::max<tmsize_t>(size, 0)));
    std::memcpy(target, file.bytes.data.get() + file.position, std::size_t(count));
    file.position += count;
    return tmsize_t(count);
}

toff_t seek_memory(thandle_t handle, toff_t offset, int whence)
{
    MemoryFile& file = *static_cast<MemoryFile*>(handle);
    const std::uint64_t base = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? file.position : file.bytes.size;
    file.position = std::min<std::uint64_t>(base + offset, file.bytes.size);
    return file.position;
}

int keep_complaint(TIFF*, void* file, const char*, const char* format, va_list arguments)
{
    char text[256];
    std::vsnprintf(text, sizeof text, format, arguments);
    static_cast<MemoryFile*>(file)->complaint = text;
    return 1;
}

using TiffHandle = std::unique_ptr<TIFF, void (*)(TIFF*)>;

TiffHandle open_tiff(MemoryFile& file)
{
    TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, tmsize_t(kMostBytes));
    TIFFOpenOptionsSetErrorHandlerExtR(options, keep_complaint, &file);
    TIFFOpenOptionsSetWarningHandlerExtR(
        options, [](TIFF*, void*, const char*, const char*, va_list) { return 1; }, nullptr);
    TIFF* tiff = TIFFClientOpenExt(
        "reference", "rm", &file, read_memory, [](thandle_t, void*, tmsize_t) { return tmsize_t(0); }, seek_memory,
        [](thandle_t) { return 0; },
        [](thandle_t handle) { return toff_t(static_cast<MemoryFile*>(handle)->bytes.size); },
        [](thandle_t, void**, toff_t*) { return 0; }, [](thandle_t, void*, toff_t) {}, options);
    TIFFOpenOptionsFree(options);
    return { tiff, [](TIFF* opened) {
                if (opened)
                    TIFFClose(opened);
            } };
}

/// One tile or strip of the image, as libtiff numbers them.
struct Block {
    std::uint32_t index;
    int x, y, width, height; ///< as stored; may reach beyond the image
};

std::vector<Block> blocks_of(TIFF* tiff, const DngDescription& dng)
{
    std::uint32_t width = std::uint32_t(dng.stored_width), height = std::uint32_t(dng.stored_height);
    const bool tiled = TIFFIsTiled(tiff) != 0;
    if (tiled) {
        TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
        TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
    } else {
        TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &height);
        height = std::min(height, std::uint32_t(dng.stored_height));
    }
    std::vector<Block> blocks;
    if (width < 1 || height < 1 || std::max(width, height) > 65536 ||
        (std::uint64_t(dng.stored_width) / width + 1) * (std::uint64_t(dng.stored_height) / height + 1) > kMostBlocks)
        return blocks;
    for (int y = 0; y < dng.stored_height; y += int(height))
        for (int x = 0; x < dng.stored_width; x += int(width))
            blocks.push_back({ std::uint32_t(blocks.size()), x, y, int(width), int(height) });
    return blocks;
}

/// Decodes one block into the image; false if the data are damaged or not finite.
bool read_block(TIFF* tiff, const DngDescription& dng, const Block& block, std::vector<unsigned char>& buffer,
                float* image)
{
    const std::size_t bytes_per_sample = std::size_t(dng.bits) / 8, samples = std::size_t(dng.samples);
    const int rows = std::min(block.height, dng.stored_height - block.y);
    const int columns = std::min(block.width, dng.stored_width - block.x);
    const std::size_t row_bytes = std::size_t(block.width) * samples * bytes_per_sample;
    const tmsize_t wanted = tmsize_t(row_bytes * std::size_t(TIFFIsTiled(tiff) ? block.height : rows));
    const tmsize_t got = TIFFIsTiled(tiff) ? TIFFReadEncodedTile(tiff, block.index, buffer.data(), wanted)
                                           : TIFFReadEncodedStrip(tiff, block.index, buffer.data(), wanted);
    if (got != wanted)
        return false;
    for (int row = 0; row < rows; ++row) {
        const unsigned char* source = buffer.data() + std::size_t(row) * row_bytes;
        float* target =
            image + (std::size_t(block.y + row) * std::size_t(dng.stored_width) + std::size_t(block.x)) * samples;
        for (std::size_t i = 0; i < std::size_t(columns) * samples; ++i) {
            if (bytes_per_sample == 4) {
                std::memcpy(&target[i], source + 4 * i, 4);
            } else {
                std::uint16_t half;
                std::memcpy(&half, source + 2 * i, 2);
                target[i] = float_from_half(half);
            }
            if (!std::isfinite(target[i]))
                return false;
        }
    }
    return true;
}

} // namespace

Expected<RawImage> decode_float_dng(const FileBytes& file, const DngDescription& dng)
{
    if (dng.bits != 16 && dng.bits != 32)
        return Error{ "floating point DNG of " + std::to_string(dng.bits) + " bits: only 16 and 32 are supported" };
    const std::uint64_t values =
        std::uint64_t(dng.stored_width) * std::uint64_t(dng.stored_height) * std::uint64_t(dng.samples);
    if (values * sizeof(float) > kMostBytes)
        return Error{ "floating point DNG of " + std::to_string(values) + " values, the limit is " +
                      std::to_string(kMostBytes / sizeof(float)) };
    if (std::min(dng.layout.width, dng.layout.height) < 2)
        return Error{ "floating point DNG with an active area under 2 x 2 pixels" };

    MemoryFile memory{ file, 0, {} };
    const TiffHandle tiff = open_tiff(memory);
    if (!tiff || !TIFFSetSubDirectory(tiff.get(), dng.folder_offset))
        return Error{ "damaged DNG: " + memory.complaint };
    const std::vector<Block> blocks = blocks_of(tiff.get(), dng);
    if (blocks.empty() ||
        std::uint64_t(blocks[0].width) * std::uint64_t(blocks[0].height) * 4 * std::uint64_t(dng.samples) > kMostBytes)
        return Error{ "floating point DNG with tiles or strips of impossible size" };
    std::vector<unsigned char> buffer(std::size_t(blocks[0].width) * std::size_t(blocks[0].height) * 4 *
                                      std::size_t(dng.samples));
    const std::shared_ptr<float[]> image(new float[std::size_t(values)]);
    for (const Block& block : blocks)
        if (!read_block(tiff.get(), dng, block, buffer, image.get()))
            return Error{ "damaged floating point DNG (NaN, infinity or wrong data in the block at x " +
                          std::to_string(block.x) + ", y " + std::to_string(block.y) +
                          (memory.complaint.empty() ? ")" : "): " + memory.complaint) };

    RawImage result{ dng.layout, dng.facts, dng.notes };
    result.pixels.owner = image;
    result.pixels.pixel_stride = dng.samples;
    result.pixels.row_stride = std::ptrdiff_t(dng.stored_width) * dng.samples;
    result.pixels.floats = image.get() + dng.top * result.pixels.row_stride + std::ptrdiff_t(dng.left) * dng.samples;
    return result;
}

} // namespace srisp
