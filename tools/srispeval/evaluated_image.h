// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "measure.h"
#include "method.h"
#include "report/report_page.h"
#include "test_image.h"

namespace srisp::tool {

/// What was found out of one test image.
struct EvaluatedImage {
    ImageScore score;
    ImagePictures pictures;
    /// By method; absent where the camera's matrix is not known.
    std::map<std::string, LabCounts> lab;
    /// ln of the channel means, of the reference and of each method's result.
    std::array<double, 3> reference_log_means{};
    std::map<std::string, std::array<double, 3>> log_means;
};

/// How pictures for the report are made.
struct PictureSettings {
    int longest = 0; ///< pixels; 0: none are made
};

/// Runs all methods on the image. Errors: those of a method.
Expected<EvaluatedImage> evaluate_image(const TestImage& image, const Methods& methods,
                                        const MeasureSettings& measuring, const PictureSettings& pictures);

/// The results of one photo with several references: adds to each its share of the rank correlations, over the
/// references, of the log channel means of results and references.
void add_rank_correlations(std::vector<EvaluatedImage>& images, const Methods& methods);

} // namespace srisp::tool
