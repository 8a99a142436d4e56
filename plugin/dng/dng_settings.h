// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/dng.h>
#include <srisp/expected.h>

namespace srisp::plugin {

/// How an image is to be written, as its attributes say it.
struct DngSettings {
    DngOptions options;
    bool floats = false; ///< of options.bits; else integers
    bool quiet = false;  ///< no notes
};

/// Reads `dng:layout` (standard, cinema), `dng:datatype` (uint16, half, float), `dng:bits` or `oiio:BitsPerSample` (10
/// to 16, of integers), `compression` (none, lossless, deflate), `dng:quiet` (0, 1). Names of other formats'
/// compressions, and another `oiio:BitsPerSample`, are what an image brought from its file, and count as not said.
/// Errors: other names and values, the near ones listed.
Expected<DngSettings> read_dng_settings(const OIIO::ImageSpec& spec);

} // namespace srisp::plugin
