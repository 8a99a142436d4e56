// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

#include "recipe/recipe.h"

namespace srisp {

/// Prints the parameters that the job would apply to the image in a slot, as one line of JSON on stdout: `{"image":
/// name, …}`.
Status print_parameters(const Recipe& job, const std::string& slot_id);

/// Writes the parameters recorded in an image to the job's `file`, in whose last part `####` or `%04d` is replaced by
/// the frame number.
Status save_parameters(const Recipe& job, const OIIO::ImageSpec& spec, const std::string& frame);

} // namespace srisp
