// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/tensors/random.h"

namespace srisp::train {

/// How a camera or a RAW converter renders: one gain and one curve whatever the scene, so that a RAW image that is too
/// dark gives a picture that is too dark. What they use differs: base curves with toe and shoulder, filmic curves,
/// none at all; per channel or keeping hues; sRGB's, BT.709's or another gamma; styles of contrast and saturation.
struct CameraIspSettings {
    double balance_error = 0.04, cast = 0.15, coolest_cast = -0.3, warmest_cast = 0.6;
    double lowest_exposure = 0.1, highest_exposure = 1.4;
    double gain = 1.3, gain_spread = 0.3;
    double plain = 0;
    double auto_brightness = 0.15;
    double other_matrix = 0.3;
    double curved = 0.75, lowest_middle = 0, highest_middle = 1.2, lowest_contrast = 1, highest_contrast = 1.6;
    double rolled_off = 0.5, keeps_hue = 0.4;
    double srgb = 0.55, bt709 = 0.2, lowest_gamma = 1.8, highest_gamma = 2.4;
    double lowest_saturation = 0.85, highest_saturation = 1.4;
    double lowest_style = -0.2, highest_style = 0.5;

    template<class Visitor> void describe(Visitor& v)
    {
        v.number("balance_error", balance_error, 0, 0.5, "error of the white balance's gains, ± this part");
        v.number("cast", cast, 0, 1, "share balanced for another light than the scene's, as by fixed daylight");
        v.range("cast_strength", coolest_cast, warmest_cast, -1, 1,
                "ln of the red gain's error there, and of the blue one's the other way");
        v.range("exposure", lowest_exposure, highest_exposure, 1e-3, 100,
                "the simulation's exposure of what is rendered so; drawn evenly in its log");
        v.number("gain", gain, 0.1, 10, "median over cameras of the gain of the RAW");
        v.number("gain_spread", gain_spread, 0, 2, "deviation of its ln between cameras");
        v.number("plain", plain, 0, 1, "share of those without a tone curve whose gain is 1, as RAW converters'");
        v.number("auto_brightness", auto_brightness, 0, 1,
                 "share brightened until the brightest channel clips in 1 % of the pixels, as dcraw does");
        v.number("other_matrix", other_matrix, 0, 1, "share with a mix of other cameras' matrices, not its own");
        v.number("curved", curved, 0, 1, "share with a tone curve; the rest is clipped");
        v.range("middle", lowest_middle, highest_middle, -1, 2, "ln of how much the curve brightens middle grey, 0.18");
        v.range("contrast", lowest_contrast, highest_contrast, 0.5, 3, "exponent of the curve's toe");
        v.number("rolled_off", rolled_off, 0, 1,
                 "share of curves that hold what the gain puts above white, part of it or all");
        v.number("keeps_hue", keeps_hue, 0, 1, "share of curves that act on the largest channel");
        v.number("srgb", srgb, 0, 1, "share with sRGB's encoding");
        v.number("bt709", bt709, 0, 1, "share with BT.709's; the rest gets a plain gamma");
        v.range("gamma", lowest_gamma, highest_gamma, 1, 4, "that gamma: display = linear^(1/gamma)");
        v.range("saturation", lowest_saturation, highest_saturation, 0, 4, "of the style, linear");
        v.range("style", lowest_style, highest_style, -1, 2,
                "contrast of the style: part of an S-curve on the picture");
    }
};

/// The gain of a camera: log-normal.
double draw_camera_gain(const CameraIspSettings& settings, Random random);

/// Renders RAW images [N, 3, H, W] in [0, 1], each whole, to display-encoded 8 bit values in [0, 1]. `white_balance`
/// [N, 3] and `color` [N, 3, 3] (white-balanced camera RGB → linear sRGB) are the true ones, `others` [N or 1, K, 3,
/// 3] those of other cameras, `gains` [N] each camera's.
torch::Tensor render_camera(const CameraIspSettings& settings, const torch::Tensor& raw,
                            const torch::Tensor& white_balance, const torch::Tensor& color, const torch::Tensor& others,
                            const torch::Tensor& gains, const Randoms& randoms);

} // namespace srisp::train
