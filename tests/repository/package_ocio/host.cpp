// SPDX-License-Identifier: Apache-2.0
// A host of OpenColorIO that links us: a config and a reference RAW → a grey pixel, unprocessed; no bake, no file.
#include <cstdio>

#include <srisp/ocio_context.h>

int main(int, char** argv)
{
    const auto config = OCIO_NAMESPACE::Config::CreateFromFile(argv[1]);
    const auto context = config->getCurrentContext()->createEditableCopy();
    context->setStringVar("SRISP_REFERENCE", argv[2]);
    const auto transform = srisp::transform_from_context(config, context);
    if (!transform)
        return std::fprintf(stderr, "%s\n", transform.error().message.c_str()), 1;
    float pixel[] = { 0.5f, 0.5f, 0.5f };
    config->getProcessor(*transform)->getDefaultCPUProcessor()->applyRGB(pixel);
    std::printf("%.5f %.5f %.5f\n", pixel[0], pixel[1], pixel[2]);
}
