// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "scores.h"

namespace srisp::tool {

/// GroupSummary::camera of the cameras that no model was trained on.
constexpr char kUnseenCameras[] = "unseen cameras";

/// The groups of all images: each rendering as a whole, then by camera where there are several, then those of cameras
/// that are not in `seen` where that is not empty and they are not all. Each method's means with bootstrap intervals,
/// and its differences to the first method.
std::vector<GroupSummary> summarize(const std::vector<ImageScore>& images, const std::vector<std::string>& methods,
                                    const std::set<std::string>& seen);

} // namespace srisp::tool
