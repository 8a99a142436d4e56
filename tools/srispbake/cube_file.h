// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <OpenColorIO/OpenColorIO.h>

#include "bake_errors.h"

namespace srisp::tool {

/// One table of `size`³ colours over [0,1]³ for the whole pipeline, for programs that know nothing else.
class CubeTable {
public:
    /// Throws Failure.
    CubeTable(const Chosen& chosen, Direction direction, int size);

    /// What such a program does with it, tetrahedral.
    OCIO_NAMESPACE::ConstTransformRcPtr transform() const;
    /// A .cube file; each line of `comments` becomes a comment. [Adobe Cube LUT 1.0]
    std::string text(const std::string& title, const std::vector<std::string>& comments) const;

private:
    int m_size;
    std::vector<float> m_rgb; ///< red runs fastest
};

} // namespace srisp::tool
