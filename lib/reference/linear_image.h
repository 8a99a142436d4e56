// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <srisp/expected.h>
#include <srisp/reference.h>

namespace srisp {

/// A reference that is an image already: thumbnail (upright), facts and notes.
struct LinearImage {
    Thumbnail thumbnail;
    CameraFacts facts;
    std::vector<std::string> notes;
};

/// Reads an EXR (any of half or float; camera RGB in [0,1]) or a TIFF that srisp wrote (16 bits or float) row by row.
/// `format`: OpenImageIO's name, "openexr" or "tiff". Values are clipped to [0,1]. Errors, without the file's name: no
/// R, G, B; integer EXR, deep images, images marked as display-encoded, TIFF without srisp's metadata, NaN or infinity,
/// damage.
Expected<LinearImage> load_linear_image(const std::string& path, const std::string& format);

} // namespace srisp
