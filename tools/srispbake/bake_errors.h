// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <OpenColorIO/OpenColorIO.h>
#include <srisp/apply.h>

#include "bake_choice.h"

namespace srisp::tool {

/// Of |a − b| over all channels.
struct ErrorSize {
    double largest = 0, sum = 0;
    std::int64_t values = 0;

    void add(const std::vector<float>& a, const std::vector<float>& b);
    double mean() const { return values ? sum / static_cast<double>(values) : 0; }
};

/// How far one bake is from what it stands for, in the units of its result.
struct BakeErrors {
    ErrorSize grid;                 ///< against the pointwise pipeline, over a dense grid of colours
    std::optional<ErrorSize> photo; ///< the same over the photo
    std::optional<ErrorSize>
        full; ///< against the full pipeline on the photo; `process`: each from its own RAW-like image
};

/// Applies the bake as a host does (CPU, default optimisation). Throws Failure.
BakeErrors measure_errors(const OCIO_NAMESPACE::ConstTransformRcPtr& bake, const BakeChoice& choice,
                          Direction direction);

} // namespace srisp::tool
