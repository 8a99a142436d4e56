// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "photo/pixel_source.h"

namespace srisp {

/// Some rows of one level, all channels as stored.
struct StoredRows {
    int y0, y1;
    std::vector<float> values;
    const float* row(int y, std::size_t row_length) const { return values.data() + (y - y0) * row_length; }
};

/// Reads bands of rows that overlap by a halo from a source that is read fastest from top to bottom, where going back
/// means decoding again from the start: rows that were read just before are kept, not read again.
class RowWindow {
public:
    RowWindow(PixelSource& source, int subimage, int miplevel, std::size_t row_length)
        : m_source(source), m_subimage(subimage), m_miplevel(miplevel), m_row_length(row_length)
    {
    }

    /// The rows y0 ≤ y < y1. What is returned never changes, so it may be used while others are asked for.
    Expected<std::shared_ptr<const StoredRows>> rows(int y0, int y1);

private:
    PixelSource& m_source;
    int m_subimage, m_miplevel;
    std::size_t m_row_length; ///< floats
    std::shared_ptr<const StoredRows> m_last;
};

} // namespace srisp
