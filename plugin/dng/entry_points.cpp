// SPDX-License-Identifier: Apache-2.0
// What OpenImageIO looks for in a plugin; exports.map hides everything else. There is no reader: OpenImageIO's own
// reads DNG.
#include <OpenImageIO/imageio.h>

#include "dng_output.h"

OIIO_PLUGIN_EXPORTS_BEGIN

OIIO_EXPORT int dng_imageio_version = OIIO_PLUGIN_VERSION;
OIIO_EXPORT const char* dng_imageio_library_version()
{
    return "srisp " SRISP_VERSION;
}

OIIO_EXPORT OIIO::ImageOutput* dng_output_imageio_create()
{
    return new srisp::plugin::DngOutput;
}
OIIO_EXPORT const char* dng_output_extensions[] = { "dng", nullptr };

OIIO_PLUGIN_EXPORTS_END
