// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

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

/// What the Lab histograms of a result and of its truth (else its reference) count. Empty where the camera's matrix is
/// not known.
struct LabCounts {
    std::vector<std::int64_t> result, wanted;
};

/// How far a result is from the image's truth. `lab` may be null.
MethodScore measure_result(const TestImage& image, const MethodResult& result, const MeasureSettings& settings,
                           LabCounts* lab = nullptr);

/// Without a truth: what can be said of the result beside its reference. `lab` may be null.
MethodScore measure_unpaired(const TestImage& image, const MethodResult& result, LabCounts* lab = nullptr);

} // namespace srisp::tool
