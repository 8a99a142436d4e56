// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

namespace srisp::train {

/// Which method, and its ablations. The defaults are this project's; the paper's own model is encoder_input plain,
/// statistics and anchor off [method 2].
struct ModelSettings {
    std::string method = "srisp";
    std::string kernel_size = "3";
    int dictionary_size = 5;
    std::string encoder_input = "perceptual";
    bool statistics = true, anchor = true, anchor_network = true;
    std::string selection = "dynamic", gain = "separate", tone = "dynamic", gamma = "dynamic";
    int unet_channels = 16;

    /// Where the colour dictionary starts (camera RGB → linear sRGB, row-major): matrices of different cameras. Empty:
    /// the four DND cameras and a mild one. Not read from recipes; a trainer may take them from its pack.
    std::vector<std::array<float, 9>> initial_color;

    /// No white-balance gain is below 1 and global gains below 1 rebuild clipped highlights, as in srisp-7: a camera's
    /// clipped white is white then. What is left of the gains is the global one's. Not read from recipes: new models
    /// have it where they can, and a model file says whether its model has.
    bool white_stays_white = true;

    template<class Visitor> void describe(Visitor& v)
    {
        v.choice("method", method, { "srisp", "mbispld", "unet", "upi", "gain_match" },
                 "srisp, or a baseline; the settings below are srisp's, mbispld fixes most of them");
        v.choice("kernel_size", kernel_size, { "3", "1" }, "of the tone map; 1: pointwise");
        v.integer("dictionary_size", dictionary_size, 1, 64, "atoms per dictionary, K [P 3.1]");
        v.choice("encoder_input", encoder_input, { "perceptual", "plain" }, "plain: as in the paper");
        v.flag("statistics", statistics, "12 brightness statistics join the features");
        v.flag("anchor", anchor, "gains start from a regression of brightness; needs statistics");
        v.flag("anchor_network", anchor_network, "a small network corrects that regression; needs the anchor");
        v.choice("selection", selection, { "dynamic", "intermediate", "static" },
                 "intermediate: without source and reference features; static: one parameter set for all images");
        v.choice("gain", gain, { "separate", "merged" }, "merged: gain and white balance are one dictionary");
        v.choice("tone", tone, { "dynamic", "static" }, "static: one tone map for all images");
        v.choice("gamma", gamma, { "dynamic", "static" }, "static: one gamma for all images");
        v.integer("unet_channels", unet_channels, 4, 128, "of the first level of the U-Net");
    }

    /// Without what needs something that is off, and as `mbispld` fixes them: gain and white balance in one dictionary,
    /// one gamma, one 1×1 tone map, selection from the intermediate images alone [P 4.2]; others unchanged.
    ModelSettings resolved() const
    {
        ModelSettings s = *this;
        s.anchor_network = anchor && anchor_network && method == "srisp";
        s.white_stays_white = white_stays_white && s.anchor_network && gain == "separate";
        if (method != "mbispld")
            return s;
        s.kernel_size = "1";
        s.encoder_input = "plain";
        s.statistics = s.anchor = false;
        s.selection = "intermediate";
        s.gain = "merged";
        s.tone = s.gamma = "static";
        return s;
    }
};

} // namespace srisp::train
