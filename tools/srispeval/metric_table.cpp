// SPDX-License-Identifier: Apache-2.0
#include "metric_table.h"

#include <algorithm>

namespace srisp::tool {

const std::vector<Metric>& metrics()
{
    static const std::vector<Metric> table{
        { key::kPsnr, "PSNR", "dB", 2, Better::higher, "peak signal-to-noise ratio of the linear RAW, peak 1" },
        { key::kSsim, "SSIM", "", 4, Better::higher, "structural similarity of the linear RAW" },
        { key::kAngle, "angle", "°", 2, Better::lower, "mean angle between the colours of result and truth" },
        { key::kDeltaE, "ΔE2000", "", 2, Better::lower,
          "mean CIEDE2000 difference under the camera's matrix, which tells colour and brightness as seen" },
        { key::kLab, "Lab intersection", "", 3, Better::higher, "part that the Lab histograms of both have in common" },
        { key::kLabPooled, "Lab, all images", "", 3, Better::higher,
          "the same of the histograms over all images together, as the paper has it" },
        { key::kBrightness, "ln mean error", "", 3, Better::near_zero,
          "error of the brightness: 0.1 is 10 % too bright" },
        { key::kHighlights, "highlights", "", 3, Better::near_zero, "mean error where the truth is above 0.8" },
        { key::kHighlightsAtGain, "highlights at gain", "", 3, Better::near_zero,
          "the same after one gain for the whole image that fits the truth's middle" },
        { key::kEdits, "PSNR after edits", "dB", 2, Better::higher,
          "PSNR in sRGB after result and truth were rendered alike, in several random ways" },
        { key::kPsnrAtGain, "PSNR at true gain", "dB", 2, Better::higher,
          "PSNR after one gain for the image that gives the truth's mean: what is left is colour and tone" },
        { key::kPsnrAtMeans, "PSNR at true means", "dB", 2, Better::higher,
          "PSNR after a gain for each channel that gives the truth's mean" },
        { key::kDeviation, "deviation told", "EV", 2, Better::lower,
          "standard deviation of the brightness that results say of themselves" },
        { key::kErrorInDeviations, "error in deviations", "", 2, Better::lower,
          "size of the brightness error in the deviations told" },
        { key::kWithinOne, "within one", "", 2, Better::higher,
          "share of brightness errors within one deviation told; 0.68 is right" },
        { key::kWithinTwo, "within two", "", 2, Better::higher, "within two; 0.95 is right" },
        { key::kRankRed, "rank, R", "", 2, Better::higher,
          "rank correlation of a photo's results with their references, by brightness, in R" },
        { key::kRankGreen, "rank, G", "", 2, Better::higher, "in G" },
        { key::kRankBlue, "rank, B", "", 2, Better::higher, "in B" },
    };
    return table;
}

const Metric& metric(const std::string& key)
{
    return *std::find_if(metrics().begin(), metrics().end(), [&](const Metric& one) { return one.key == key; });
}

} // namespace srisp::tool
