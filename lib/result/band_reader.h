// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
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
    bool associate = true;             ///< multiply alpha in
    bool progress = false;             ///< on stderr
    int threads = 0;                   ///< as ApplyOptions
    std::function<bool()> cancelled{}; ///< as in Recipe
};

/// Computes the result of one level band by band, in the order in which rows are asked for: the image as a whole is
/// never in memory. A band of which all is asked for goes straight to its place; of others the last are kept. Not for
/// use by several threads at a time, but a call may be made within a call (a thread that waits for others may be given
/// the host's next request).
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
    /// Where rows of the result go, all channels.
    struct Target {
        float* values;
        std::size_t row_stride;
    };
    struct Band {
        int index;
        std::shared_ptr<float[]> values;
    };

    int end_of(int band) const;
    std::shared_ptr<const Band> kept(int index) const;
    Expected<std::shared_ptr<const Band>> band(int index);
    Status compute(int index, Target target);
    Status apply(const PhotoRows& rows, Roi roi, Target rgb);

    PixelSource& m_source;
    BandSettings m_settings;
    int m_width, m_height, m_stored_channels, m_channels, m_band_rows;
    PhotoReader m_reader;
    SpareMemory m_memory;
    std::vector<std::shared_ptr<const Band>> m_last; ///< newest first
    std::vector<bool> m_done;
    std::size_t m_bands_done = 0;
    PhotoCounts m_counts;
    ProgressLine m_progress;
};

} // namespace srisp
