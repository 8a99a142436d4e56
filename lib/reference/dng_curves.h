// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace srisp {

/// The curves of a DNG's opcode list: MapTable and MapPolynomial, which lossy DNGs need to become linear. They map
/// values in [0,1] to such. [DNG 1.4, chapter 7]
class DngCurves {
public:
    /// `list`: the bytes of OpcodeList2. What is damaged, or is no curve, is left out, and `complete` is false.
    explicit DngCurves(const std::string& list);

    bool empty() const { return m_curves.empty(); }
    bool complete() const { return m_complete; }

    /// Maps row `y` of the active area, `width` pixels of `channels` values, in place.
    void apply(int y, int width, int channels, float* row) const;

private:
    struct Curve {
        double top, left, bottom, right, plane, planes, row_pitch, column_pitch;
        std::vector<float> table; ///< evenly spaced over [0,1], interpolated
    };

    bool add(unsigned opcode, const std::string& parameters);

    std::vector<Curve> m_curves;
    bool m_complete = true;
};

} // namespace srisp
