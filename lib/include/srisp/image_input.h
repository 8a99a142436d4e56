// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <variant>

#include <OpenImageIO/imageio.h>

namespace srisp {

/// An image in the caller's memory; it owns no pixels.
struct MemoryImage {
    /// Size, channels, type of the values (8 or 16 bits, half, float, double), and what the image says of itself as
    /// OpenImageIO's readers tell it: `Orientation`, `oiio:ColorSpace`, `ICCProfile`, what srisp recorded. Colour is
    /// straight where `oiio:UnassociatedAlpha` says so, else multiplied with alpha.
    OIIO::ImageSpec spec;
    const void* pixels = nullptr; ///< the first channel of pixel (0, 0)
    /// Bytes from a value to the next one in each direction; below 0, too. AutoStride: they are adjacent.
    OIIO::stride_t channel_stride = OIIO::AutoStride, x_stride = OIIO::AutoStride, y_stride = OIIO::AutoStride;
    std::string name; ///< in messages, and where a seed and the photo's name decide something
};

/// An image to read: a file, or one in memory, which outlives the call it is given to.
class ImageInput {
public:
    ImageInput(const char* path) : m_input(std::string(path)) {}
    ImageInput(std::string path) : m_input(std::move(path)) {}
    ImageInput(MemoryImage image) : m_input(std::move(image)) {}

    /// Null: it is a file.
    const MemoryImage* memory() const { return std::get_if<MemoryImage>(&m_input); }
    /// The file's path, or the name of what is in memory.
    const std::string& name() const { return memory() ? memory()->name : std::get<std::string>(m_input); }

private:
    std::variant<std::string, MemoryImage> m_input;
};

} // namespace srisp
