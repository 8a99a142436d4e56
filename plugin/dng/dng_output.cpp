// SPDX-License-Identifier: Apache-2.0
#include "dng_output.h"

#include <algorithm>

#include <srisp/neutral_rendition.h>

#include "base/guarded.h"
#include "base/shown_text.h"
#include "container/image_limits.h"
#include "container/image_memory.h"
#include "dng/dng_check.h"
#include "dng/dng_writer.h"
#include "dng_xmp.h"
#include "result/kept_results.h"

namespace srisp::plugin {

namespace {

void print_notes(const std::vector<std::string>& notes)
{
    // Never destroyed: other threads of the host may still write while statics end.
    static KeptResults& kept = *new KeptResults;
    kept.print_notes("DNG", notes);
}

/// A picture of the image as a plain converter would make it.
std::vector<std::uint8_t> preview_of(DngSamples::Picture picture, const CameraFacts& facts)
{
    render_neutrally(picture.rgb, facts);
    std::vector<std::uint8_t> preview(picture.rgb.size());
    std::transform(picture.rgb.begin(), picture.rgb.end(), preview.begin(),
                   [](float value) { return std::uint8_t(value * 255 + 0.5f); });
    return preview;
}

} // namespace

int DngOutput::supports(OIIO::string_view feature) const
{
    // Rows in any order. The windows are for oiiotool, which would fill what a format lacks of the display window with
    // black.
    return feature == "random_access" || feature == "displaywindow" || feature == "negativeorigin" ||
           feature == "ioproxy";
}

bool DngOutput::fail(const std::string& message)
{
    m_samples.reset();
    errorfmt("{}", valid_utf8(message));
    return false;
}

bool DngOutput::succeeds(const std::function<Status()>& step)
{
    const Status done = guarded("dng", {}, step);
    return done || fail(done.error().message);
}

Status DngOutput::begin(const std::string& name, const OIIO::ImageSpec& spec)
{
    const auto error = [&](const std::string& message) { return Error{ "DNG '" + name + "': " + message }; };
    if (spec.deep)
        return error("a deep image cannot be a RAW file; flatten it first");
    if (spec.depth > 1)
        return error("a volume cannot be a RAW file");
    if (const Status size = check_dng_size(spec.width, spec.height); !size)
        return error(size.error().message);
    if (const Status size = check_size(spec); !size)
        return error("cannot be written: it " + size.error().message);
    if (const Status fits = check_memory(spec.image_pixels(), spec.nchannels); !fits)
        return error("cannot be written: it " + fits.error().message);
    const auto settings = read_dng_settings(spec);
    if (!settings)
        return error(settings.error().message);
    auto samples = DngSamples::create(spec, *settings);
    if (!samples)
        return error(samples.error().message);
    if (const Status possible = check_dng_image(samples->image(), settings->options); !possible)
        return error(possible.error().message);
    m_path = name;
    m_settings = *settings;
    m_samples = std::move(*samples);
    m_is_written = false;
    m_spec = spec;
    m_spec.set_format(OIIO::TypeFloat);
    m_spec.channelformats.clear();
    m_spec.tile_width = m_spec.tile_height = m_spec.tile_depth = 0;
    return {};
}

bool DngOutput::open(const std::string& name, const OIIO::ImageSpec& spec, OpenMode mode)
{
    if (mode != Create)
        return fail("DNG '" + name + "': holds one image, no further ones and no MIP levels");
    m_samples.reset();
    return succeeds([&] { return begin(name, spec); });
}

bool DngOutput::write_scanline(int y, int z, OIIO::TypeDesc format, const void* data, OIIO::stride_t xstride)
{
    if (!m_samples)
        return false; // told before
    const int row = y - m_spec.y;
    if (row < 0 || row >= m_spec.height)
        return fail("DNG '" + m_path + "': scanline " + std::to_string(y) + " lies outside the image");
    return succeeds([&]() -> Status {
        std::vector<unsigned char> scratch;
        m_spec.auto_stride(xstride, format, m_spec.nchannels);
        const void* const native = to_native_scanline(format, data, xstride, scratch, 0, y, z);
        const bool was_whole = m_samples->missing() == 0;
        if (const Status put = m_samples->put(row, static_cast<const float*>(native)); !put)
            return Error{ "DNG '" + m_path + "': " + put.error().message };
        m_is_written = false;
        return was_whole || m_samples->missing() > 0 ? Status() : finish();
    });
}

bool DngOutput::close()
{
    if (!m_samples)
        return true;
    const bool finished = m_is_written || succeeds([&] { return finish(); });
    m_samples.reset();
    return finished;
}

Expected<std::vector<std::string>> DngOutput::write_to_proxy(const DngImage& image)
{
    MemorySink memory;
    auto notes = write_dng(memory, image, m_settings.options);
    if (!notes)
        return Error{ "DNG '" + m_path + "': " + notes.error().message };
    const std::string& bytes = memory.bytes();
    if (m_proxy->pwrite(bytes.data(), bytes.size(), 0) != bytes.size())
        return Error{ "DNG '" + m_path + "': cannot be written to the host's memory" };
    return notes;
}

Status DngOutput::finish()
{
    if (const int missing = m_samples->missing())
        return Error{ "DNG '" + m_path + "': " + std::to_string(missing) + " of " + std::to_string(m_spec.height) +
                      " rows were never written" };
    DngImage image = m_samples->image();
    image.description = m_spec.get_string_attribute("ImageDescription");
    image.xmp = xmp_of(m_spec);
    image.date_time = m_spec.get_string_attribute("DateTime");
    image.artist = m_spec.get_string_attribute("Artist");
    image.copyright = m_spec.get_string_attribute("Copyright");
    std::vector<std::uint8_t> preview;
    if (m_settings.options.layout == DngLayout::standard) {
        constexpr int kPreviewSide = 1024;
        DngSamples::Picture picture = m_samples->picture(kPreviewSide);
        image.preview_width = picture.width;
        image.preview_height = picture.height;
        preview = preview_of(std::move(picture), image.facts);
        image.preview = preview.empty() ? nullptr : preview.data();
    }
    const auto written = m_proxy ? write_to_proxy(image) : write_dng(m_path, image, m_settings.options);
    if (!written)
        return written.error();
    m_is_written = true;
    if (!m_settings.quiet) {
        print_notes(m_samples->notes());
        print_notes(*written);
    }
    return {};
}

} // namespace srisp::plugin
