// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/dng.h>

namespace srisp {

/// The white level of a plane: the image's, or the largest that there can be.
std::uint32_t white_level(const DngImage& image, const DngOptions& options, std::size_t plane);

/// Whether an image can have such sides. Errors, without the file's name.
Status check_dng_size(int width, int height);

/// Whether an image can be written so: sizes, planes, phase, levels, bits, compression, preview. Errors, without the
/// file's name.
Status check_dng_image(const DngImage& image, const DngOptions& options);

/// Whether its samples are finite, and not of more bits. Errors name the first pixel that is not.
Status check_dng_samples(const DngImage& image, const DngOptions& options);

} // namespace srisp
