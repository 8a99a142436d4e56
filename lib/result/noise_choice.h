// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/camera.h>
#include <srisp/expected.h>
#include <srisp/noise.h>

#include "recipe/recipe.h"
#include "result/kept_results.h"

namespace srisp {

/// The noise that a recipe asks for. `sensor`: of the camera that the image imitates; `photo_name`, `seed`: what
/// chooses among several references, and what `upi` draws from. What took long is kept. Errors: those of the source of
/// figures; nothing says which camera or reference it is.
Expected<NoiseModel> choose_noise(const Recipe& recipe, const CameraFacts& sensor, const std::string& photo_name,
                                  std::uint64_t seed, KeptResults& kept);

} // namespace srisp
