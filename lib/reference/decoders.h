// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>
#include <srisp/reference.h>

#include "base/file_bytes.h"
#include "reference/dng_description.h"
#include "reference/raw_pixels.h"

// The decoders of references: LibRaw's, ours for what it can't, and the one for images that are linear already.

namespace srisp {

struct SampleLayout;

/// Decodes a RAW file by the decoder that can. Errors: as below.
Expected<RawImage> decode_raw(const FileBytes& file);

/// Decodes a RAW file with LibRaw. `dng`: its description if it is a DNG, which then decides all but the samples; else
/// null. Errors, without the file's name: nothing that LibRaw knows, truncated or damaged data, sensors that are not
/// RGB mosaics, data that are no sensor values any more. Threads: safe.
Expected<RawImage> decode_with_libraw(const FileBytes& file, const DngDescription* dng);

/// Decodes a floating point DNG (16 or 32 bits; uncompressed or Deflate) with libtiff; Debian's LibRaw can't. Errors,
/// without the file's name: other bit depths and predictors, damaged data, NaN or infinity.
Expected<RawImage> decode_float_dng(const FileBytes& file, const DngDescription& dng);

/// Decodes a DNG whose image data are lossy JPEGs of 8 bits (`dng.lossy`; LinearRaw, or a mosaic of one sample per
/// pixel) with libjpeg, and makes it linear by its LinearizationTable and the curves of its OpcodeList2: LibRaw ignores
/// the one, and decodes no mosaics. Errors, without the file's name: damaged data, JPEGs of other sizes than the tags
/// say.
Expected<RawImage> decode_lossy_dng(const FileBytes& file, const DngDescription& dng);

/// Reads plain samples without a header. Errors, without the file's name: a file of another size than the layout says,
/// samples of more bits.
Expected<RawImage> decode_plain_samples(const FileBytes& file, const SampleLayout& layout);

/// A reference that is an image already: thumbnail (upright), facts and notes.
struct LinearReference {
    Thumbnail thumbnail;
    CameraFacts facts;
    std::vector<std::string> notes;
};

/// Refuses mosaics that srisp wrote as images, which are neither RAW files nor linear ones.
Status check_no_mosaic(const OIIO::ImageSpec& spec);

/// Reads an EXR (any of half or float; camera RGB in [0,1]) or a TIFF that srisp wrote (16 bits or float) row by row.
/// `format`: OpenImageIO's name, "openexr" or "tiff". Values are clipped to [0,1]. Errors, without the file's name: no
/// R, G, B; integer EXR, deep images, images marked as display-encoded, TIFF without srisp's metadata, NaN or infinity,
/// damage.
Expected<LinearReference> read_linear_reference(const std::string& path, const std::string& format);

} // namespace srisp
