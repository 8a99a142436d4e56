// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <srisp/dng.h>

#include "base/file_bytes.h"
#include "reference/decoders.h"
#include "scratch_folder.h"

namespace srisp {

/// An image with the memory that it is a view of: a ramp with noise, a camera of two matrices.
class MadeImage {
public:
    MadeImage(int width, int height, int planes, int bits = 16)
        : m_shorts(std::size_t(width) * std::size_t(height) * std::size_t(planes))
    {
        std::uint32_t state = 1;
        for (std::size_t i = 0; i < m_shorts.size(); ++i) {
            state = state * 1664525 + 1013904223;
            m_shorts[i] = std::uint16_t((i * 3 + (state >> 24)) & ((1u << bits) - 1));
        }
        image.width = width;
        image.height = height;
        image.planes = planes;
        image.shorts = m_shorts.data();
        image.row_stride = std::ptrdiff_t(width) * planes;
        image.cfa_pattern = planes == 1 ? "RGGB" : "";
        image.facts.make = "Maker";
        image.facts.model = "Model 5";
        image.facts.orientation = 6;
        image.facts.color_matrices = {
            { { 0.9f, -0.2f, -0.1f, -0.4f, 1.2f, 0.2f, -0.1f, 0.2f, 0.6f }, 17 },
            { { 0.7034f, -0.0804f, -0.1014f, -0.442f, 1.2564f, 0.2058f, -0.0851f, 0.1994f, 0.5758f }, 21 }
        };
        image.facts.as_shot_neutral = { 0.4737f, 1, 0.6512f };
        image.facts.iso = 400;
        image.facts.exposure_time_s = 1.0f / 60;
        image.facts.f_number = 2.8f;
    }
    MadeImage(const MadeImage&) = delete;
    MadeImage& operator=(const MadeImage&) = delete;

    /// Floats instead: thirds of the integers, so that they need all bits.
    MadeImage& as_floats()
    {
        for (const std::uint16_t value : m_shorts)
            m_floats.push_back(float(value) / (3 * 65535.0f) - 0.01f);
        image.shorts = nullptr;
        image.floats = m_floats.data();
        return *this;
    }
    MadeImage& with_preview(int width, int height)
    {
        for (int i = 0; i < width * height * 3; ++i)
            m_preview.push_back(std::uint8_t(i * 7));
        image.preview = m_preview.data();
        image.preview_width = width;
        image.preview_height = height;
        return *this;
    }
    std::uint16_t& sample(std::size_t i) { return m_shorts[i]; }
    float& float_sample(std::size_t i) { return m_floats[i]; }
    const std::vector<std::uint8_t>& preview() const { return m_preview; }

    DngImage image;

private:
    std::vector<std::uint16_t> m_shorts;
    std::vector<float> m_floats;
    std::vector<std::uint8_t> m_preview;
};

/// Writes what must be writable; gives the notes.
inline std::vector<std::string> written(const std::string& path, const DngImage& image, const DngOptions& options = {})
{
    const auto notes = write_dng(path, image, options);
    REQUIRE_MESSAGE(notes, (notes ? "" : notes.error().message));
    return *notes;
}

inline FileBytes read_file(const std::string& path)
{
    const auto file = read_whole_file(path);
    REQUIRE(file);
    return *file;
}

/// Decodes what must be decodable.
inline RawImage decoded(const std::string& path)
{
    const auto raw = decode_raw(read_file(path));
    REQUIRE_MESSAGE(raw, (raw ? "" : raw.error().message));
    return *raw;
}

/// How many samples differ; floats as they are in `bits`.
inline long different_samples(const RawPixels& pixels, const DngImage& image)
{
    REQUIRE(pixels.width == image.width);
    REQUIRE(pixels.height == image.height);
    REQUIRE(pixels.channels == image.planes);
    long count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.planes; ++c) {
                const std::ptrdiff_t at = y * pixels.row_stride + x * pixels.pixel_stride + c;
                const std::ptrdiff_t from = y * image.row_stride + x * image.planes + c;
                count +=
                    image.shorts ? pixels.shorts[at] != image.shorts[from] : pixels.floats[at] != image.floats[from];
            }
    return count;
}

} // namespace srisp
