// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>
#include <srisp/image.h>

/// Nanoseconds per pixel of OpenColorIO's CPU processor, default optimisation, one core: the pointwise model's two
/// directions with the parameters that it chooses for these thumbnails, and, to compare, an ACES 1.0 SDR output
/// transform (ACEScg to sRGB). Taken in turns, the best of each. Ends the program where something fails.
nlohmann::ordered_json measure_ocio(const srisp::Thumbnail& source, const srisp::Thumbnail& reference);

/// The same as a line of text.
std::string ocio_line(const nlohmann::ordered_json& measured);
