// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/image.h>
#include <srisp/parameters.h>

namespace srisp {

class Model;

/// Chooses the parameters that turn the photo into what the camera of the reference would have recorded in its light.
/// `source`: display-encoded photo; `reference`: linear RAW, both upright, values in [0,1]; NaN is an error. Sets all
/// but `reference_name` and `reference_hash`. Gain and white balance stay within what training showed the model; where
/// they had to be moved, a sentence on it is added to `notes`. Same bits for the same input on one machine. [P 3.1]
SRISP_API Expected<Parameters> select(const Model& model, const Thumbnail& source, const Thumbnail& reference,
                                      std::vector<std::string>* notes = nullptr);

} // namespace srisp
