// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <srisp/apply.h>

#include "base/progress.h"
#include "photo/photo_reader.h"

namespace srisp {

/// How the bands of one level are made.
struct BandSettings {
    std::shared_ptr<const PhotoConverter> converter;
    std::shared_ptr<const Applier> applier;
    bool associate = true; ///< multiply alpha in
    bool progress = false; ///< on stderr
    int threads = 0;       ///< as ApplyOptions
};

/// Computes the result of one level band by band, in the order in which rows are asked for, and keeps the last bands:
/// the image as a whole is never in memory. Not for use by several threads at a time, but a call may be made within a
/// call (a thread that waits for others may be given the host's next request).
class BandReader {
public:
    BandReader(PixelSource& source, int subimage, int miplevel, const OIIO::ImageSpec& stored, BandSettings settings);

    /// Columns x0 ≤ x < x1 of rows y0 ≤ y < y1 (relative to the data window), all output channels; `row_stride` in
    /// floats.
    Status read(int x0, int x1, int y0, int y1, float* out, std::size_t row_stride);

    /// Of the rows computed so far, each counted once.
    const PhotoCounts& counts() const { return m_counts; }
    bool complete() const { return m_bands_done == m_done.size(); }

private:
    struct Band {
        int index;
        std::vector<float> values;
    };

    Expected<std::shared_ptr<const Band>> band(int index);
    Expected<std::shared_ptr<const Band>> compute(int index);

    PixelSource& m_source;
    int m_width, m_height, m_stored_channels, m_channels, m_band_rows;
    BandSettings m_settings;
    PhotoReader m_reader;
    std::vector<std::shared_ptr<const Band>> m_last; ///< newest first
    std::vector<bool> m_done;
    std::size_t m_bands_done = 0;
    PhotoCounts m_counts;
    ProgressLine m_progress;
};

} // namespace srisp
