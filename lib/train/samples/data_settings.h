// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "train/samples/camera_isp.h"
#include "train/samples/random_isp.h"
#include "train/samples/simulation.h"

namespace srisp::train {

/// How a pack becomes samples. "Render whole, then crop": an exposure is rendered once, for the whole scene; source,
/// truth and reference are crops of it. Defaults: method.md sections 4 and 6, second series.
struct DataSettings {
    SimulationSettings simulation;
    RandomIspSettings isp;
    CameraIspSettings camera;
    int image_size = 64;
    bool open_only = true;
    double whole_share = 0.5;
    double raw_share = 0;
    double lowest_raw_exposure = 0.3, highest_raw_exposure = 3;
    double fixed_share = 0, lowest_fixed_target = 0.9, highest_fixed_target = 0.9;
    double camera_share = 0;
    double other_scene = 0.25, half_split = 0.40, upright_split = 0.25;
    double smallest_crop = 0.4;
    double blurred = 0;
    int smallest_detail = 24;
    bool flip = true, rotate = true;

    template<class Visitor> void describe(Visitor& v)
    {
        v.group("simulation", simulation);
        v.group("isp", isp);
        v.group("camera", camera);
        v.integer("image_size", image_size, 16, 1024, "width and height of samples, px");
        v.flag("open_only", open_only, "only images that a model may be given away with");
        v.number("whole_share", whole_share, 0, 1, "share of scenes that are whole photos; the rest: the pack's crops");
        v.number("raw_share", raw_share, 0, 1, "share of scenes that are real RAW images of the pack, not simulated");
        v.range("raw_exposure", lowest_raw_exposure, highest_raw_exposure, 1e-3, 100,
                "factor on real RAW, evenly in its log: stored ones have lost their exposure");
        v.number("fixed_share", fixed_share, 0, 1,
                 "share of scenes rendered for a fixed target and with the camera's own matrix");
        v.number("camera_share", camera_share, 0, 1,
                 "share of scenes rendered as cameras do, with one gain whatever the scene; the rest: ISP_rand");
        v.range("fixed_target", lowest_fixed_target, highest_fixed_target, 0.1, 2,
                "where these put the 97th percentile of the white-balanced mean");
        v.number("other_scene", other_scene, 0, 1, "share of references from another scene, camera and light the same");
        v.number("half_split", half_split, 0, 1,
                 "share of references that are one half of the scene, the source a quarter of the other; the rest of "
                 "the references are another crop of the scene");
        v.number("upright_split", upright_split, 0, 1,
                 "share of these that split top and bottom, as in upright photos");
        v.number("smallest_crop", smallest_crop, 0.05, 1, "shortest side of a crop, in parts of the scene's");
        v.number("blurred", blurred, 0, 1, "share of thumbnails that are enlarged from fewer pixels");
        v.integer("smallest_detail", smallest_detail, 4, 1024, "fewest pixels that these are enlarged from");
        v.flag("flip", flip, "mirror half of the samples");
        v.flag("rotate", rotate, "turn samples by multiples of 90°");
    }
};

} // namespace srisp::train
