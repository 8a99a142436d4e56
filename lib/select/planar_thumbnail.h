// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <srisp/image.h>

#include "kernels/pointwise.h"
#include "select/layers.h"

namespace srisp {

/// A square image as three planes, with the room that the kernels need.
class PlanarThumbnail {
public:
    PlanarThumbnail() = default; ///< of no pixels
    explicit PlanarThumbnail(int size) : m_size(size), m_values(3 * (count() + kRowSlack)) {}
    /// A thumbnail reduced to `size` × `size` by area means.
    PlanarThumbnail(const Thumbnail& thumbnail, int size);

    int size() const { return m_size; }
    std::size_t count() const { return std::size_t(m_size) * m_size; }
    /// Kernels take what they read and what they write as one type.
    Planes planes() const { return { const_cast<float*>(m_values.data()), std::ptrdiff_t(count()) + kRowSlack }; }

private:
    int m_size = 0;
    std::vector<float> m_values;
};

/// How encoders see linear light: max(v, floor)^exponent, then an offset added.
struct EncoderScale {
    float exponent, floor, offset;
};

/// Brings it to a scale like that of displayed images [method 2], unless the model wants it plain.
EncoderScale linear_scale(bool perceptual);

/// Three of an encoder's inputs: values that already have the encoder's exponent.
void add_to_input(EncoderInput& input, int first_channel, Planes values, float offset);

/// The image as an encoder's only input.
EncoderInput display_input(const PlanarThumbnail& image, bool perceptual);
EncoderInput linear_input(const PlanarThumbnail& image, bool perceptual);

} // namespace srisp
