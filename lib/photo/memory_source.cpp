// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <vector>

#include "container/image_limits.h"
#include "photo/code_values.h"
#include "photo/pixel_source.h"

namespace srisp {

namespace {

class MemorySource : public PixelSource {
public:
    MemorySource(MemoryImage image, std::string name) : m_image(std::move(image)), m_name(std::move(name))
    {
        static std::atomic<unsigned long> count{ 0 };
        m_key = "memory " + std::to_string(++count); // pixels may change from call to call
    }

    std::optional<OIIO::ImageSpec> find_level(int subimage, int miplevel) override
    {
        return subimage == 0 && miplevel == 0 ? std::optional(m_image.spec) : std::nullopt;
    }

    Status read_rows(int, int, int y0, int y1, float* rows) override
    {
        const OIIO::ImageSpec& spec = m_image.spec;
        const auto* first = static_cast<const unsigned char*>(m_image.pixels) + y0 * m_image.y_stride;
        const std::size_t row = std::size_t(spec.width) * std::size_t(spec.nchannels);
        if (are_codes(spec.format) && has_adjacent_values()) {
            for (int y = y0; y < y1; ++y, first += m_image.y_stride, rows += row)
                if (spec.format == OIIO::TypeUInt8)
                    codes_to_floats(first, row, rows);
                else
                    codes_to_floats(reinterpret_cast<const std::uint16_t*>(first), row, rows);
            return {};
        }
        return copy_values(first, y1 - y0, rows) ? Status() : Status(Error{ m_name + ": cannot be converted" });
    }

    const std::string& name() const override { return m_name; }
    const std::string& key() const override { return m_key; }

private:
    bool has_adjacent_values() const
    {
        const auto value = OIIO::stride_t(m_image.spec.format.size());
        return m_image.channel_stride == value && m_image.x_stride == value * m_image.spec.nchannels;
    }

    /// OpenImageIO's conversion takes pixels whose channels are adjacent.
    bool copy_values(const unsigned char* from, int height, float* to) const
    {
        const OIIO::ImageSpec& spec = m_image.spec;
        const auto value = OIIO::stride_t(sizeof(float)), pixel = value * spec.nchannels;
        const int together = m_image.channel_stride == OIIO::stride_t(spec.format.size()) ? spec.nchannels : 1;
        for (int c = 0; c < spec.nchannels; c += together)
            if (!OIIO::convert_image(together, spec.width, height, 1, from + c * m_image.channel_stride, spec.format,
                                     m_image.x_stride, m_image.y_stride, OIIO::AutoStride, to + c, OIIO::TypeFloat,
                                     pixel, pixel * spec.width, OIIO::AutoStride))
                return false;
        return true;
    }

    MemoryImage m_image;
    std::string m_name, m_key;
};

} // namespace

Expected<std::unique_ptr<PixelSource>> open_memory_source(const MemoryImage& given, const std::string& kind)
{
    MemoryImage image = given;
    OIIO::ImageSpec& spec = image.spec;
    const std::string name = kind + (image.name.empty() ? " in memory" : " '" + image.name + "'");
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
        return Error{ name + ": is empty: " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                      " pixels of " + std::to_string(spec.nchannels) + " channels" };
    if (const Status size = check_size(spec); !size)
        return Error{ name + ": " + size.error().message };
    if (!image.pixels)
        return Error{ name + ": has no pixels" };
    if (spec.depth > 1 || spec.deep || !spec.channelformats.empty())
        return Error{ name + ": is a volume, deep, or of mixed types" };
    spec.tile_width = spec.tile_height = spec.tile_depth = 0;
    const auto value = OIIO::stride_t(spec.format.size());
    if (image.channel_stride == OIIO::AutoStride)
        image.channel_stride = value;
    if (image.x_stride == OIIO::AutoStride)
        image.x_stride = image.channel_stride * spec.nchannels;
    if (image.y_stride == OIIO::AutoStride)
        image.y_stride = image.x_stride * spec.width;
    return std::unique_ptr<PixelSource>(std::make_unique<MemorySource>(std::move(image), name));
}

Expected<std::unique_ptr<PixelSource>> open_source(const ImageInput& input, const std::string& kind,
                                                   const OIIO::ImageSpec& config)
{
    const MemoryImage* const image = input.memory();
    return image ? open_memory_source(*image, kind) : open_file_source(input.name(), kind, config);
}

} // namespace srisp
