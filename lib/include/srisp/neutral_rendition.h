// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <srisp/camera.h>
#include <srisp/export.h>
#include <srisp/reference.h>

namespace srisp {

/// The picture that a plain converter would make of a reference: white-balanced by the as-shot neutral (where the file
/// has none: grey world), clipped where the first channel is (so that clipped highlights have no colour), exposed so
/// that the 97th percentile of the channels' mean becomes 0.85, clipped, brought to sRGB by the camera's matrix (each
/// row sums to 1; where it has none: as it is), clipped, encoded with the sRGB curve. It stands in for the photo where
/// there is none. Deterministic; any number of threads.
SRISP_API Thumbnail neutral_rendition(const Reference& reference);

/// The same of any picture in linear camera RGB, in place: three values a pixel.
SRISP_API void render_neutrally(std::vector<float>& rgb, const CameraFacts& facts);

} // namespace srisp
