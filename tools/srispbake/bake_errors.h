// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake_choice.h"
#include <OpenColorIO/OpenColorIO.h>

namespace srisp::tool {

/// Of |a − b| over all channels.
struct ErrorSize {
    double largest = 0, sum = 0;
    std::int64_t values = 0;

    void add(const std::vector<float>& a, const std::vector<float>& b);
    double mean() const { return values ? sum / static_cast<double>(values) : 0; }
};

/// How far one bake is from the library's pixels, in the units of its result.
struct BakeErrors {
    ErrorSize grid;                 ///< over a dense grid of colours
    std::optional<ErrorSize> photo; ///< over the photo; but for `unprocess` over its RAW-like image
};

/// Applies the bake as a host does (CPU, default optimisation). Throws Failure.
BakeErrors measure_errors(const OCIO_NAMESPACE::ConstTransformRcPtr& bake, const BakeChoice& choice, BakeKind kind);

} // namespace srisp::tool
