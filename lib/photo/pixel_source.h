// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>
#include <srisp/image_input.h>
#include <srisp/options.h>

#include "gain_map/gain_map.h"

namespace srisp {

/// Where the pixels of a photo come from: a file, or memory (hand-over). Not for use by several threads at a time.
class PixelSource {
public:
    virtual ~PixelSource() = default;

    /// The spec of one level; none: there is no such subimage or level.
    virtual std::optional<OIIO::ImageSpec> find_level(int subimage, int miplevel) = 0;
    /// Rows y0 ≤ y < y1 of the data window (the first is 0), all channels as float.
    virtual Status read_rows(int subimage, int miplevel, int y0, int y1, float* rows) = 0;
    /// The next pass over the rows of a subimage, from top to bottom, is for its thumbnail; by this source or another
    /// one of the same pixels there may be a second pass, for the result.
    virtual void expect_second_pass(int) {}

    /// What this is called in messages.
    virtual const std::string& name() const = 0;
    /// Says which pixels these are, for caches: differs when the file changes.
    virtual const std::string& key() const = 0;
    /// The gain map that is to be applied, for the first picture; null: none is.
    virtual const GainMap* gain_map() const { return nullptr; }
    /// What reading has shown so far, beside what the spec says.
    virtual const std::vector<std::string>& notes() const
    {
        static const std::vector<std::string> none;
        return none;
    }
};

/// Hints for open_file_source and ImageFile: `config` with what a user asks for.
OIIO::ImageSpec reading_hints(const Options& options, const OIIO::ImageSpec& config = {});

/// Opens an image file as ImageFile does, colour straight; `kind` says what it is to be: "photo" gives the name
/// "photo 'path'", and so errors start. `config`: the host's hints. Reads headers only.
Expected<std::unique_ptr<PixelSource>> open_file_source(const std::string& path, const std::string& kind,
                                                        const OIIO::ImageSpec& config = {});

/// An image in memory, whose pixels are read as they are needed. `kind` as above; without a name it is "photo in
/// memory". Errors: no pixels, or too many; a volume.
Expected<std::unique_ptr<PixelSource>> open_memory_source(const MemoryImage& image, const std::string& kind);

/// Whichever it is.
Expected<std::unique_ptr<PixelSource>> open_source(const ImageInput& input, const std::string& kind,
                                                   const OIIO::ImageSpec& config = {});

} // namespace srisp
