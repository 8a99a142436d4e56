// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

#include "photo/pixel_source.h"
#include "recipe/recipe.h"

namespace srisp {

class KeptResults;

/// An image whose specs and pixels are made when they are asked for. Not for use by several threads at a time.
class ComputedImage {
public:
    virtual ~ComputedImage() = default;

    /// Whether what must be decoded first is to be left out of specs as long as possible.
    virtual bool is_lazy() const = 0;

    /// The spec without decoding anything. Null: there is no such level.
    virtual Expected<const OIIO::ImageSpec*> header(int subimage, int miplevel) = 0;

    /// The whole spec. May decode the photo and the reference.
    virtual Expected<const OIIO::ImageSpec*> full_spec(int subimage, int miplevel, int threads) = 0;

    /// Columns x0 ≤ x < x1 of rows y0 ≤ y < y1 relative to the data window, all channels; `row_stride` in floats.
    virtual Status read(int subimage, int miplevel, int threads, int x0, int x1, int y0, int y1, float* out,
                        std::size_t row_stride) = 0;
};

/// The image that a recipe stands for. `kept` outlives it; `config`: the host's hints. Reads headers only; finds what
/// can be wrong without decoding the photo or the reference.
Expected<std::unique_ptr<ComputedImage>> open_computed_image(const Recipe& recipe, std::unique_ptr<PixelSource> source,
                                                             const OIIO::ImageSpec& config, KeptResults& kept);

} // namespace srisp
