// SPDX-License-Identifier: Apache-2.0
#include "../common/failure.h"
#include "batch_options.h"

namespace srisp::tool {

namespace {

/// Half floats are as exact as a RAW file's codes; TIFF readers seldom know them.
OutputDepth usual_depth(OutputFormat format)
{
    switch (format) {
    case OutputFormat::tif:
        return OutputDepth::float32;
    case OutputFormat::dng:
    case OutputFormat::png:
        return OutputDepth::uint16;
    case OutputFormat::exr:
    case OutputFormat::npy:
        break;
    }
    return OutputDepth::half;
}

void check_format(const MakingOptions& options)
{
    const std::string depth = std::string("--depth ") + depth_name(options.depth) + ": ";
    if (options.format == OutputFormat::exr && options.depth == OutputDepth::uint16)
        fail_usage(depth + "EXR holds half and float");
    if (options.format == OutputFormat::png && options.depth != OutputDepth::uint16)
        fail_usage(depth + "PNG holds 16 bits");
    if (options.format == OutputFormat::tif && options.depth == OutputDepth::half)
        fail_usage(depth + "TIFF holds uint16 and float");
    if (options.format == OutputFormat::npy && !options.compression.empty())
        fail_usage("--compression: a NumPy file has none");
}

} // namespace

const char* format_name(OutputFormat format)
{
    static const char* const kNames[] = { "exr", "dng", "tif", "png", "npy" };
    return kNames[int(format)];
}

const char* depth_name(OutputDepth depth)
{
    static const char* const kNames[] = { "half", "float", "uint16" };
    return kNames[int(depth)];
}

void MakingOptions::finish()
{
    depth = given_depth.value_or(usual_depth(format));
    check_format(*this);
    const auto set = [&](const std::string& key, const std::string& value) {
        if (const Status done = set_option(image, key, value); !done)
            fail_usage(done.error().message);
    };
    // What is typed comes later, and counts.
    if (depth != OutputDepth::float32)
        set("precision", "fast");
    if (mosaic)
        set("mosaic", "reference");
    const bool phase_typed = [&] {
        for (const auto& [key, value] : image_settings)
            if (key == "mosaic")
                return true;
        return false;
    }();
    if (depth == OutputDepth::uint16 && (mosaic || phase_typed))
        set("levels", "camera");
    for (const auto& [key, value] : image_settings)
        set(key, value);
    if (format == OutputFormat::dng && !image.develop.empty())
        fail_usage("--develop: a DNG holds camera RGB");
}

} // namespace srisp::tool
