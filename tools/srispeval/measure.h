// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include <srisp/metrics.h>

#include "method.h"
#include "test_image.h"

namespace srisp::tool {

/// How results are measured.
struct MeasureSettings {
    int edits = 5;          ///< forward renderings after which result and truth are compared
    std::uint64_t seed = 1; ///< of these
};

/// Log chromaticity of the mean; none where a channel is black.
std::optional<Chromaticity> chromaticity_of(const Pixels& pixels);

/// How far a result is from the image's truth.
MethodScore measure_result(const TestImage& image, const MethodResult& result, const MeasureSettings& settings);

/// Without a truth: what can be said of the result beside its reference.
MethodScore measure_unpaired(const TestImage& image, const MethodResult& result);

} // namespace srisp::tool
