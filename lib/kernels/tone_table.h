// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include "kernels/pixel_tone_map.h"

namespace srisp {

/// The tone map of a pointwise model as a table over the unit cube, tetrahedral between its points. Its 575 KB stay in
/// L2, or nearly; on photos it is within 0.07 codes of 10 bits (0.024 with 65 points along an edge, which take eight
/// times the memory and the time to make them).
class ToneTable {
public:
    static constexpr int kSide = 33; ///< points along an edge
    static constexpr std::size_t kPoints = std::size_t(kSide) * kSide * kSide;
    static constexpr std::size_t kStride = 4; ///< floats from a point to the next: RGB and one that is not used

    ToneTable() : m_values(new float[kPoints * kStride]) {}

    /// v + φ(v), not clamped, where the first channel is `red` / (kSide − 1). Different ones may run at a time.
    void fill_plane(const PixelToneMap& tone_map, int red);

    /// Red runs slowest, blue fastest.
    const float* values() const { return m_values.get(); }

private:
    std::unique_ptr<float[]> m_values;
};

} // namespace srisp
