// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "host.h"

namespace srisp::tool {

/// In the output folder, for as long as the fit lasts.
constexpr char kAnchorPairsFile[] = "anchor_pairs.safetensors";

/// How the anchor is fitted before the first step; nothing where the recipe takes a finished one as it is.
std::optional<train::AnchorFitSettings> anchor_fit_of(const train::TrainingRecipe& recipe);

/// Gives the session's model the anchor that the recipe asks for: another model's, a fit, or a further fit of the one
/// that it has, which is taken back where the validation says that it does harm, as it can with few images. Pairs that
/// an earlier run has kept are gone on from unless `restart` is set. Calls `still_there` now and then. After a signal
/// it keeps what it has and throws Interrupted.
void start_anchor(Session& session, Host& host, bool quiet, bool restart, const train::StillThere& still_there);

} // namespace srisp::tool
