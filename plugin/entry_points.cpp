// SPDX-License-Identifier: Apache-2.0
// What OpenImageIO looks for in a plugin; exports.map hides everything else.
#include <OpenImageIO/imageio.h>

#include "srisp_input.h"
#include "srisp_output.h"

OIIO_PLUGIN_EXPORTS_BEGIN

OIIO_EXPORT int srisp_imageio_version = OIIO_PLUGIN_VERSION;
OIIO_EXPORT const char* srisp_imageio_library_version()
{
    return "srisp " SRISP_VERSION;
}

OIIO_EXPORT OIIO::ImageInput* srisp_input_imageio_create()
{
    return new srisp::plugin::SrispInput;
}
OIIO_EXPORT const char* srisp_input_extensions[] = { "srisp", nullptr };

OIIO_EXPORT OIIO::ImageOutput* srisp_output_imageio_create()
{
    return new srisp::plugin::SrispOutput;
}
OIIO_EXPORT const char* srisp_output_extensions[] = { "srisp", nullptr };

OIIO_PLUGIN_EXPORTS_END
