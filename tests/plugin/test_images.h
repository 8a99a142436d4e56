// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include "scratch_folder.h"
#include "srisp_input.h"

/// Smooth shapes with a little noise, the same on every machine; `channels` values per pixel in [low, high].
inline std::vector<float> test_pixels(int width, int height, int channels, float low = 0.05f, float high = 0.95f)
{
    std::vector<float> pixels;
    std::uint32_t state = 1;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) {
                state = state * 1664525u + 1013904223u;
                const float wave = (x * (c + 1) % 61) / 61.0f * 0.6f + (y * (3 - c % 3) % 47) / 47.0f * 0.3f;
                pixels.push_back(low + (high - low) * (wave + 0.1f * float(state >> 8) / (1 << 24)));
            }
    return pixels;
}

/// Writes one image; `spec` says size, channels and type.
inline void write_image(const std::string& path, const OIIO::ImageSpec& spec, const std::vector<float>& pixels)
{
    auto output = OIIO::ImageOutput::create(path);
    REQUIRE(output);
    REQUIRE_MESSAGE(output->open(path, spec), output->geterror());
    REQUIRE_MESSAGE(output->write_image(OIIO::TypeFloat, pixels.data()), output->geterror());
    REQUIRE(output->close());
}

/// A float EXR, which the library takes as camera RGB.
inline std::string write_reference(const ScratchFolder& folder, const std::string& name = "reference.exr",
                                   float brightness = 0.3f)
{
    const std::string path = folder.path(name);
    write_image(path, OIIO::ImageSpec(64, 48, 3, OIIO::TypeFloat), test_pixels(64, 48, 3, 0.01f, brightness));
    return path;
}

/// An 8-bit PNG.
inline std::string write_photo(const ScratchFolder& folder, const std::string& name = "photo.png", int width = 90,
                               int height = 70)
{
    const std::string path = folder.path(name);
    write_image(path, OIIO::ImageSpec(width, height, 3, OIIO::TypeUInt8), test_pixels(width, height, 3));
    return path;
}

inline std::vector<float> read_all(OIIO::ImageInput& input, int subimage = 0, int miplevel = 0)
{
    const OIIO::ImageSpec spec = input.spec_dimensions(subimage, miplevel);
    std::vector<float> pixels(std::size_t(spec.width) * spec.height * spec.nchannels);
    REQUIRE_MESSAGE(input.read_image(subimage, miplevel, 0, spec.nchannels, OIIO::TypeFloat, pixels.data()),
                    input.geterror());
    return pixels;
}

/// Opens through our reader; fails the test where that fails.
inline OIIO::ImageSpec open_ours(srisp::plugin::SrispInput& input, const std::string& name,
                                 const OIIO::ImageSpec& config = {})
{
    OIIO::ImageSpec spec;
    REQUIRE_MESSAGE(input.open(name, spec, config), input.geterror());
    return spec;
}

/// The whole image that our reader gives for a name.
inline std::vector<float> result_of(const std::string& name, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config = {})
{
    srisp::plugin::SrispInput input;
    spec = open_ours(input, name, config);
    return read_all(input);
}

/// Why our reader refuses a name.
inline std::string refusal_of(const std::string& name, const OIIO::ImageSpec& config = {})
{
    srisp::plugin::SrispInput input;
    OIIO::ImageSpec spec;
    REQUIRE(!input.open(name, spec, config));
    return input.geterror();
}

inline bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}
