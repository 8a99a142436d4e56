// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

namespace srisp {

/// Where the pixels of a photo come from: a file, or memory (hand-over). Not for use by several threads at a time.
class PixelSource {
public:
    virtual ~PixelSource() = default;

    /// The spec of one level; none: there is no such subimage or level.
    virtual std::optional<OIIO::ImageSpec> find_level(int subimage, int miplevel) = 0;
    /// Rows y0 ≤ y < y1 of the data window (the first is 0), all channels as float.
    virtual Status read_rows(int subimage, int miplevel, int y0, int y1, float* rows) = 0;

    /// What this is called in messages.
    virtual const std::string& name() const = 0;
    /// Says which pixels these are, for caches: differs when the file changes.
    virtual const std::string& key() const = 0;
};

/// Opens what any reader but our own opens: a file, or a name that a reader understands; `config`: the host's hints.
/// Straight colour is asked for, so that nothing is lost in dark transparent pixels. Reads headers only. Where a file
/// breaks off, pixels are what its reader makes of them. Errors start with "source 'path'".
Expected<std::unique_ptr<PixelSource>> open_file_source(const std::string& path, const OIIO::ImageSpec& config);

/// The same for a regular file that must be whole: what its reader warns of is an error. `kind` says what the file is
/// to be: "photo" gives the name "photo 'path'", and so errors start.
Expected<std::unique_ptr<PixelSource>> open_whole_file_source(const std::string& path, const std::string& kind);

} // namespace srisp
