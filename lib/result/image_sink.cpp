// SPDX-License-Identifier: Apache-2.0
#include "result/image_sink.h"

#include <algorithm>

#include "container/image_memory.h"

namespace srisp {

Status begin_image(const ImageSink& sink, const OIIO::ImageSpec& spec, const std::string& where)
{
    constexpr int kLeastChannels = 3; // those that a mosaic is made of
    if (sink.holds_all)
        if (const Status fits = check_memory(spec.image_pixels(), std::max(spec.nchannels, kLeastChannels)); !fits)
            return Error{ where + ": what is made of it " + fits.error().message };
    return sink.begin(spec);
}

} // namespace srisp
