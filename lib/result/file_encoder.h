// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

namespace srisp {

/// What the file of an image will hold: `image` as a writer of such files is told it, with values of `type`, or of the
/// kind's own (OpenEXR half, TIFF, FITS and Radiance float, others 16 bits).
OIIO::ImageSpec file_spec(const OIIO::ImageOutput& output, const OIIO::ImageSpec& image, OIIO::TypeDesc type);

/// The bytes of an image file, made in memory from rows that come one after the other. Errors are the writer's own, and
/// without the file's name.
class FileEncoder {
public:
    /// `name`: its ending says which kind of file. Errors: no writer, or none that writes to memory.
    static Expected<FileEncoder> create(const std::string& name);

    /// `compression`: as the writer calls it; empty: its usual one.
    Status begin(const OIIO::ImageSpec& image, OIIO::TypeDesc type, const std::string& compression);
    /// The next rows, all channels as float.
    Status add_rows(const float* rows, int count);
    Expected<std::vector<unsigned char>> finish();

private:
    FileEncoder(std::unique_ptr<OIIO::ImageOutput> output, const std::string& name);
    Status written(bool done) const;

    std::string m_name;
    std::unique_ptr<std::vector<unsigned char>> m_bytes;
    std::unique_ptr<OIIO::Filesystem::IOVecOutput> m_memory; ///< writes to m_bytes
    std::unique_ptr<OIIO::ImageOutput> m_output;             ///< writes to m_memory
    OIIO::ImageSpec m_spec;
    int m_next = 0; ///< row
};

} // namespace srisp
