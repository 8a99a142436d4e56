// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <srisp/expected.h>

#include "photo/pixel_source.h"
#include "recipe/recipe.h"

namespace srisp {

/// A photo of which only the first picture is left, resized and cropped as `recipe.resize` and `recipe.crop` say, in
/// the values that it is stored in, as img2dataset and oiiotool do it (OpenImageIO's filter); it is decoded whole at
/// once. Errors: the photo's own; a crop that does not fit into it.
Expected<std::unique_ptr<PixelSource>> resized_source(std::unique_ptr<PixelSource> photo, const Recipe& recipe);

} // namespace srisp
