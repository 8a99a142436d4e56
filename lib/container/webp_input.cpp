// SPDX-License-Identifier: Apache-2.0
#include "container/webp_input.h"

#include <cstring>
#include <vector>

#include <webp/decode.h>
#include <webp/demux.h>

#include "base/file_bytes.h"
#include "container/file_description.h"

namespace srisp {

namespace {

struct Demuxer {
    WebPDemuxer* handle;
    ~Demuxer() { WebPDemuxDelete(handle); }
    template<class Use> void use_chunk(const char* name, const Use& use) const
    {
        WebPChunkIterator chunk;
        if (!WebPDemuxGetChunk(handle, name, 1, &chunk))
            return;
        use(chunk.chunk.bytes, chunk.chunk.size);
        WebPDemuxReleaseChunkIterator(&chunk);
    }
};

/// The first frame on the animation's canvas.
bool decode_first_frame(const WebPData& file, std::vector<std::uint8_t>& rgba)
{
    WebPAnimDecoderOptions options;
    if (!WebPAnimDecoderOptionsInit(&options))
        return false;
    options.color_mode = MODE_RGBA;
    WebPAnimDecoder* const decoder = WebPAnimDecoderNew(&file, &options);
    std::uint8_t* frame = nullptr;
    int time = 0;
    const bool decoded = decoder && WebPAnimDecoderGetNext(decoder, &frame, &time);
    if (decoded)
        std::memcpy(rgba.data(), frame, rgba.size());
    WebPAnimDecoderDelete(decoder);
    return decoded;
}

bool decode(const WebPData& file, bool animated, const OIIO::ImageSpec& spec, std::vector<std::uint8_t>& pixels)
{
    if (animated)
        return decode_first_frame(file, pixels);
    const int stride = static_cast<int>(spec.scanline_bytes());
    return (spec.nchannels == 4 ? WebPDecodeRGBAInto : WebPDecodeRGBInto)(file.bytes, file.size, pixels.data(),
                                                                          pixels.size(), stride) != nullptr;
}

class WebpInput final : public OIIO::ImageInput {
public:
    WebpInput(OIIO::ImageSpec spec, bool animated, FileBytes bytes) : m_animated(animated), m_bytes(std::move(bytes))
    {
        m_spec = std::move(spec);
    }
    const char* format_name() const override { return "webp"; }
    int supports(OIIO::string_view feature) const override { return feature == "alpha" || feature == "exif"; }
    bool open(const std::string&, OIIO::ImageSpec&) override { return false; }
    bool close() override { return true; }
    bool seek_subimage(int subimage, int miplevel) override { return subimage == 0 && miplevel == 0; }
    bool read_native_scanline(int, int, int y, int, void* data) override
    {
        if (m_pixels.empty() && !decode_all())
            return false;
        const std::size_t row = m_spec.scanline_bytes();
        std::memcpy(data, m_pixels.data() + row * y, row);
        return true;
    }

private:
    bool decode_all()
    {
        std::vector<std::uint8_t> pixels(m_spec.image_bytes());
        if (!decode({ m_bytes.data.get(), m_bytes.size }, m_animated, m_spec, pixels))
            return false;
        m_pixels = std::move(pixels);
        m_bytes = {};
        return true;
    }

    bool m_animated;
    FileBytes m_bytes;
    std::vector<std::uint8_t> m_pixels;
};

} // namespace

Expected<std::unique_ptr<OIIO::ImageInput>> open_webp(const std::string& path)
{
    auto bytes = read_whole_file(path);
    if (!bytes)
        return bytes.error();
    const WebPData file{ bytes->data.get(), bytes->size };
    const Demuxer demuxer{ WebPDemux(&file) }; // null for a file that breaks off
    if (!demuxer.handle)
        return Error{ "damaged or truncated" };
    const auto feature = [&](WebPFormatFeature which) { return WebPDemuxGetI(demuxer.handle, which); };
    const bool animated = feature(WEBP_FF_FORMAT_FLAGS) & ANIMATION_FLAG;
    const bool alpha = animated || feature(WEBP_FF_FORMAT_FLAGS) & ALPHA_FLAG;
    OIIO::ImageSpec spec(static_cast<int>(feature(WEBP_FF_CANVAS_WIDTH)),
                         static_cast<int>(feature(WEBP_FF_CANVAS_HEIGHT)), alpha ? 4 : 3, OIIO::TypeUInt8);
    set_color_space(spec, "sRGB");
    demuxer.use_chunk("ICCP", [&](const void* data, std::size_t size) { set_icc_profile(spec, data, size); });
    demuxer.use_chunk("EXIF", [&](const std::uint8_t* data, std::size_t size) {
        // Some writers keep the mark that EXIF has in JPEG files.
        const std::size_t mark = size > 6 && std::memcmp(data, "Exif\0\0", 6) == 0 ? 6 : 0;
        add_exif(spec, data + mark, size - mark);
    });
    if (animated)
        add_note(spec,
                 "is an animation of " + std::to_string(feature(WEBP_FF_FRAME_COUNT)) + " frames; the first was taken");
    return std::unique_ptr<OIIO::ImageInput>(std::make_unique<WebpInput>(std::move(spec), animated, std::move(*bytes)));
}

} // namespace srisp
