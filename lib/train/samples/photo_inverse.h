// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/tensors/random.h"

namespace srisp::train {

/// How the unknown rendering of a photo is undone: a random member of a family, since nobody knows the true one. Steps
/// in this order; the defaults are method.md's second series (gamma and saturation only).
struct PhotoInverseSettings {
    double lowest_gamma = 1.7, highest_gamma = 3.4;
    double s_curve = 0, lowest_s_curve = 0, highest_s_curve = 1;
    double expansion = 0, lowest_white = 1, highest_white = 8;
    double histogram = 0, lowest_spread = 0.8, highest_spread = 1.7, lowest_skew = -0.4, highest_skew = 0.4;
    double lowest_strength = 0.3, highest_strength = 1;
    double flattening = 0, lowest_flattening = 0, highest_flattening = 0.7;
    double lowest_saturation = 0.7, highest_saturation = 1.5;

    template<class Visitor> void describe(Visitor& v)
    {
        v.number("s_curve", s_curve, 0, 1, "share of photos from which an S-curve (smoothstep) is removed");
        v.range("s_curve_strength", lowest_s_curve, highest_s_curve, 0, 1, "how much of it; 1 removes all of it");
        v.range("gamma", lowest_gamma, highest_gamma, 1, 6, "linear = display^gamma");
        v.number("expansion", expansion, 0, 1, "share of photos whose highlights are expanded");
        v.range("expanded_white", lowest_white, highest_white, 1, 100, "what white becomes, drawn evenly in its log");
        v.number("histogram", histogram, 0, 1, "share of photos whose luminance gets a random histogram");
        v.range("spread", lowest_spread, highest_spread, 0.05, 4, "that histogram's deviation of ln luminance");
        v.range("skew", lowest_skew, highest_skew, -1, 1, "bends it: over 0 has a longer tail to the highlights");
        v.range("histogram_strength", lowest_strength, highest_strength, 0, 1, "how far towards that histogram");
        v.number("flattening", flattening, 0, 1, "share of photos whose large parts differ less in brightness");
        v.range("flattening_strength", lowest_flattening, highest_flattening, 0, 1,
                "how much of that difference is taken away; 1 all");
        v.range("saturation", lowest_saturation, highest_saturation, 0, 4, "factor on linear chroma");
    }
};

/// Photos [N, 3, H, W], display-encoded in [0, 1], to linear sRGB ≥ 0 in which white is 1 unless it was expanded.
torch::Tensor undo_rendering(const PhotoInverseSettings& settings, const torch::Tensor& photos, Randoms& randoms);

} // namespace srisp::train
