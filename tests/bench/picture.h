// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <OpenImageIO/imagebuf.h>
#include <srisp/image.h>

/// Three interleaved float channels.
struct Picture {
    int width = 0, height = 0;
    std::vector<float> rgb;

    Picture(int w, int h) : width(w), height(h), rgb(std::size_t(3) * w * h) {}
    srisp::ImageView view() const { return { rgb.data(), width, height, 3, std::ptrdiff_t(3) * width }; }
    srisp::MutableImageView mutable_view() { return { rgb.data(), width, height, 3, std::ptrdiff_t(3) * width }; }
};

/// Upright, display-encoded sRGB. Throws std::runtime_error.
Picture load_photo(const std::string& path);

/// A sheet of square cells, pictures squashed to fit them.
class Sheet {
public:
    Sheet(int columns, int rows, int cell_px);
    /// `exponent`: of the values; 1 for what is display-encoded.
    void paste(const Picture& picture, float exponent, int column, int row);
    /// 8 bit, whole or not at all. Throws std::runtime_error.
    void write(const std::string& path) const;

private:
    OIIO::ImageBuf m_image;
    int m_cell_px;
};
