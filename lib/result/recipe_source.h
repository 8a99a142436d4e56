// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

#include "photo/pixel_source.h"
#include "recipe/recipe.h"

namespace srisp {

/// Opens the file that a recipe names (Recipe::source) as its action needs it: a camera's RAW file that is to be
/// developed as linear camera RGB, everything else as open_file_source does. `config`: the host's hints; `memory`: the
/// image in the file's place, null: there is none. Errors start with "photo 'path': ", or "image 'path': ".
Expected<std::unique_ptr<PixelSource>> open_recipe_source(const Recipe& recipe, const OIIO::ImageSpec& config,
                                                          const MemoryImage* memory = nullptr);

} // namespace srisp
