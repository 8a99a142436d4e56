// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "apply/row_ring.h"
#include "apply/tone_map.h"

namespace srisp {

/// One row that leaves the tone map.
class ToneMapOutput {
public:
    explicit ToneMapOutput(int max_tile_width) : m_stride(RowRing::plane_stride(max_tile_width)), m_values(3 * m_stride)
    {
    }

    Planes planes() { return { m_values.data(), m_stride }; }

    /// Holding φ(v), becomes clamp01(v + φ(v)).
    void add_and_clamp(Planes v, int count)
    {
        for (int c = 0; c < 3; ++c)
            for (int x = 0; x < count; ++x) {
                float& out = planes().plane(c)[x];
                out = std::min(std::max(v.plane(c)[x] + out, 0.0f), 1.0f);
            }
    }

private:
    std::ptrdiff_t m_stride;
    std::vector<float> m_values;
};

} // namespace srisp
