// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace srisp::tool {

/// A number that is a mean over what `weight` counts (images, pixels, bright values), so that those of several images
/// pool. Weight 0: there was nothing to measure.
struct Measured {
    double sum = 0, weight = 0;

    double value() const { return sum / weight; } ///< NaN where there is none
    Measured& operator+=(const Measured& other)
    {
        sum += other.sum;
        weight += other.weight;
        return *this;
    }
};

/// Which end of a measure is good.
enum class Better { higher, lower, near_zero };

/// What is measured of a result. The table of all is metrics() in image_score.h.
struct Metric {
    const char* key;   ///< in JSON and CSV: "psnr_db"
    const char* title; ///< in tables: "PSNR"
    const char* unit;  ///< "dB", "°", or ""
    int digits;        ///< behind the point
    Better better;
    const char* text; ///< one sentence that says what it is
};

/// Log chromaticity of an image's mean colour: ln(R/G), ln(B/G) of the channel means.
using Chromaticity = std::array<double, 2>;

/// Bins of the truth's values, in which errors are told apart: [0, 1/256), [1/256, 1/128), …, [1/2, 1].
constexpr int kLevels = 9;

/// One method's result on one image.
struct MethodScore {
    std::map<std::string, Measured> values;         ///< by Metric::key; what has no meaning for it is absent
    std::array<Measured, kLevels> error_by_level{}; ///< result − truth of single values, by the truth's level
    std::optional<Chromaticity> chromaticity;
    std::string parameters; ///< JSON text of the choice (to_json of Parameters, or what a baseline used); may be empty

    /// What was measured; weight 0 where that has no meaning for it.
    Measured value(const std::string& key) const
    {
        const auto found = values.find(key);
        return found == values.end() ? Measured{} : found->second;
    }
};

/// One test image: a photo, the reference it was unprocessed with, and what each method made of it.
struct ImageScore {
    std::string image;         ///< name of the file that it is about, relative to the folder given: "a/b.dng"
    std::string part;          ///< "top", "bottom", or "": all of it
    std::string rendering;     ///< how the photo came about: "fixed", "random", "camera", "embedded", "libraw", a
                               ///< converter's name; "photo" where it was given
    std::string camera;        ///< of the reference
    std::string reference;     ///< what the reference is: "left half", or a file's name
    int width = 0, height = 0; ///< pixels on which it was measured
    std::optional<Chromaticity> reference_chromaticity, truth_chromaticity;
    std::vector<std::string> notes;
    std::map<std::string, MethodScore> methods; ///< by the method's name
};

/// A mean over images with its bootstrap 95 % interval.
struct Interval {
    double mean = 0, low = 0, high = 0; ///< NaN where there is nothing
};

/// Whether a difference with this interval may be none at all.
inline bool is_within_noise(const Interval& difference)
{
    return difference.low <= 0 && difference.high >= 0;
}

/// What one method reached over a group of images.
struct MethodSummary {
    std::string method;
    std::map<std::string, Interval> values;        ///< by Metric::key
    std::map<std::string, Interval> over_baseline; ///< the method's minus the first method's, image by image; empty for
                                                   ///< that one
    Interval brightness_spread;                    ///< standard deviation of ln_mean_error over images
    std::array<Interval, kLevels> error_by_level{};
    /// Where results say how sure their brightness is: how many errors lie within z of the deviations told, for z of
    /// kCoverage.
    std::vector<double> coverage;
};

/// The z of MethodSummary::coverage.
constexpr std::array<double, 12> kCoverage{ 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2, 2.25, 2.5, 2.75, 3 };

/// Images of one rendering: all, those of one camera, or those of cameras that no model was trained on.
struct GroupSummary {
    std::string rendering;
    std::string camera; ///< "": all
    int images = 0, files = 0, cameras = 0;
    std::vector<MethodSummary> methods; ///< in the order in which they were given; the first is the baseline
};

/// A file that could not be tested, and why.
struct LeftOut {
    std::string file, reason;
};

/// Everything that an evaluation found out, but for pictures.
struct Evaluation {
    std::string protocol;                                      ///< "half-split", "pairs", "unpaired"
    std::vector<std::pair<std::string, std::string>> settings; ///< what it was made with, to be printed: name, value
    std::vector<std::string> protocol_text;                    ///< how it was measured, one paragraph each
    std::string version;                                       ///< of srisp
    std::vector<std::string> methods;                          ///< names in order; the first is the baseline
    bool has_truth = true;                                     ///< false: unpaired
    bool complete = true;                                      ///< false: it was interrupted
    std::vector<ImageScore> images;
    std::vector<LeftOut> left_out;
    std::vector<GroupSummary> groups;
};

} // namespace srisp::tool
