// SPDX-License-Identifier: Apache-2.0
#pragma once

// Small files of every container, and what tests do to them.

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

/// A picture of 16 × 12 with all kinds of colours, display-encoded.
inline std::vector<float> made_pixels(int channels)
{
    std::vector<float> pixels;
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x)
            for (int c = 0; c < channels; ++c)
                pixels.push_back(c == 3 ? 0.2f + 0.05f * y : float((x * (c + 2) * 5 + y * 13) % 200 + 20) / 255);
    return pixels;
}

/// `spec` says attributes and type; 16 × 12.
inline void write_made(const std::string& path, OIIO::ImageSpec spec)
{
    spec.width = spec.full_width = 16;
    spec.height = spec.full_height = 12;
    auto output = OIIO::ImageOutput::create(path);
    REQUIRE_MESSAGE(output, OIIO::geterror());
    REQUIRE_MESSAGE(output->open(path, spec), output->geterror());
    REQUIRE(output->write_image(OIIO::TypeFloat, made_pixels(spec.nchannels).data()));
    REQUIRE(output->close());
}

inline std::string bytes_of(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
}

inline void write_bytes(const std::string& path, const std::string& bytes)
{
    std::ofstream(path, std::ios::binary) << bytes;
}

inline std::string big_endian(std::uint32_t value, int bytes = 4)
{
    std::string text;
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
        text += static_cast<char>(value >> shift & 0xff);
    return text;
}

inline std::string little_endian(std::uint32_t value, int bytes = 4)
{
    std::string text = big_endian(value, bytes);
    return { text.rbegin(), text.rend() };
}

/// EXIF that says nothing but the orientation.
inline std::string made_exif(int orientation)
{
    return "II*" + std::string(1, '\0') + little_endian(8) + little_endian(1, 2) + little_endian(0x112, 2) +
           little_endian(3, 2) + little_endian(1) + little_endian(std::uint32_t(orientation)) + little_endian(0);
}

/// One chunk with its checksum.
inline std::string png_chunk(const std::string& type, const std::string& data)
{
    std::uint32_t crc = 0xffffffff;
    for (const char c : type + data) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return big_endian(std::uint32_t(data.size())) + type + data + big_endian(~crc);
}

/// `chunks` behind the header of a PNG file from which everything but the pixels was taken.
inline std::string png_with(const std::string& png, const std::string& chunks)
{
    const std::size_t pixels = png.find("IDAT") - 4;
    return png.substr(0, 33) + chunks + png.substr(pixels);
}
