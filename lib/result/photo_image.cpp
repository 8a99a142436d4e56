// SPDX-License-Identifier: Apache-2.0
#include "result/photo_image.h"

#include <vector>

#include <OpenImageIO/strutil.h>

#include "photo/photo_converter.h"
#include "photo/photo_reader.h"
#include "record/record.h"
#include "result/image_sink.h"

namespace srisp {

static OIIO::ImageSpec spec_of(const PhotoConverter& converter)
{
    OIIO::ImageSpec spec = converter.output_spec();
    for (const char* encoding : { "ICCProfile", "ICCProfile:.*", "Exif:ColorSpace", "oiio:Gamma", "chromaticities" })
        spec.erase_attribute(encoding);
    spec.attribute("oiio:ColorSpace", "sRGB");
    if (spec.alpha_channel >= 0)
        spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!converter.notes().empty())
        append_notes(spec, converter.notes());
    return spec;
}

Status pass_photo(PixelSource& source, const Options& options, const ImageSink& sink)
{
    const auto stored = source.find_level(0, 0);
    if (!stored)
        return Error{ source.name() + ": has no picture" };
    const auto converter = PhotoConverter::create(*stored, options.input, source.name());
    if (!converter)
        return converter.error();
    const OIIO::ImageSpec spec = spec_of(*converter);
    if (const Status begun = begin_image(sink, spec, source.name()); !begun)
        return begun;
    const std::size_t row = std::size_t(spec.width) * std::size_t(spec.nchannels);
    PhotoReader reader(source, 0, 0, *stored, *converter, options.threads);
    std::vector<float> values;
    for (int y = 0; y < spec.height;) {
        if (sink.cancelled && sink.cancelled())
            return Error{ "cancelled" };
        const auto read = reader.next(y);
        if (!read)
            return read.error();
        const PhotoRows& rows = **read;
        const float* out = rows.rgb.get();
        if (rows.stored) {
            values.resize(row * std::size_t(rows.y1 - rows.y0));
            constexpr bool kAssociate = false;
            converter->from_rgb(rows.rgb.get(), rows.stored.get(), std::int64_t(rows.y1 - rows.y0) * spec.width,
                                kAssociate, values.data());
            out = values.data();
        }
        if (const Status taken = sink.rows(out, rows.y1 - rows.y0); !taken)
            return taken;
        y = rows.y1;
    }
    return {};
}

} // namespace srisp
