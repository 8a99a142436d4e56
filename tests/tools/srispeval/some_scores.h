// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../../../tools/srispeval/metric_table.h"
#include "../../../tools/srispeval/scores.h"

/// A test image with the same measures for each of two methods, "first" and "second", whose PSNRs are these.
inline srisp::tool::ImageScore some_score(const std::string& file, const std::string& camera, double first,
                                          double second, const std::string& part = "top")
{
    using namespace srisp::tool;
    ImageScore image;
    image.image = file;
    image.part = part;
    image.rendering = "fixed";
    image.camera = camera;
    image.reference = "left half";
    image.width = 64;
    image.height = 48;
    image.truth_chromaticity = Chromaticity{ -0.5, 0.25 };
    image.notes = { "a note" };
    for (const auto& [name, psnr] : { std::pair("first", first), std::pair("second", second) }) {
        MethodScore& score = image.methods[name];
        score.values[key::kPsnr] = { psnr, 1 };
        score.values[key::kAngle] = { 3.0 * 1000, 1000 };
        score.values[key::kHighlights] = {}; // no bright pixel
        score.values[key::kBrightness] = { psnr / 100, 1 };
        score.error_by_level[3] = { -0.5, 10 };
        score.parameters = R"({"gamma":2.2})";
    }
    return image;
}
