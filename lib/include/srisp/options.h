// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/parameters.h>

namespace srisp {

enum class Direction {
    reverse, ///< display-encoded sRGB → RAW-like camera RGB ("unprocess")
    forward  ///< RAW-like camera RGB → display-encoded sRGB ("process")
};

/// How the tone map is computed; other blocks are the same in both.
enum class Precision {
    float32, ///< plain sums in float32
    fast ///< pointwise models: a table of 33³ points, tetrahedral between them, for images of 72,000 pixels and more:
         ///< on photos within 1e-4 of the above, some 1e-6 on average. Spatial ones: by bf16 where the processor has
         ///< AVX-512 BF16, on photos within 1e-3 of the above, some 1e-5 on average; elsewhere with fewer multiply-adds
         ///< in float32, within 1e-4, 1e-6 on average
};

/// How the stored colour values of an image are to be read.
enum class InputEncoding {
    automatic, ///< what the image says: colour-space name, then ICC profile, then the type (float EXR is "Linear")
    srgb,      ///< display-encoded sRGB, whatever else the image says
    linear,    ///< linear light with sRGB primaries; encoded with the sRGB curve
    camera     ///< a RAW-like image, to be processed forward: values are taken as they are
};

/// What to do with the gain map that phones keep in a JPEG photo (Ultra HDR, ISO 21496-1).
enum class GainMapUse {
    ignore, ///< the photo is its SDR rendition
    apply   ///< the photo is its HDR picture; what is brighter than SDR white goes above 1 in the result
};

/// Which colour filters lie over a RAW-like image, as over a sensor: of each pixel one channel is left.
enum class Mosaic { reference, rggb, grbg, gbrg, bggr };

/// What the values of a mosaic are.
enum class Levels {
    unit,  ///< 0 is black, 1 is white
    camera ///< as integers of 16 bits the codes of the reference's file, black level included: noise below black
           ///< survives
};

/// By how much a RAW-like image is to be brighter than it was chosen, in EV: its gain is divided by 2^EV.
struct Brightness {
    double ev = 0;       ///< below 0: darker; −kLargestBrightnessEv … kLargestBrightnessEv
    bool sample = false; ///< instead drawn from a normal distribution whose standard deviation is the parameters'
                         ///< brightness_sd_ev; the seed and the photo's name say which draw
};

/// What is white in a developed image.
struct WhiteBalance {
    enum class Kind {
        scene,      ///< what was white in the photo, or as-shot of a camera's own RAW image
        reference,  ///< what was white in the reference
        light,      ///< a surface under a light of this temperature and tint
        multipliers ///< what becomes white by these
    };
    Kind kind = Kind::scene;
    float temperature = 0; ///< kelvin, 1000 to 25000
    float tint = 0;        ///< −200 to 200: 3000 × the light's distance above the Planckian locus in CIE 1960 uv
    std::array<float, 3> multipliers{};
};

/// What becomes of highlights in a developed image, where white balance lifts channels that are saturated.
enum class Highlights {
    clip,  ///< white, where the sensor saturates (1, before exposure) or the photo was white: dcraw -H 0
    blend, ///< as bright as they are balanced, and as colourful as they are clipped: dcraw -H 2
    keep   ///< as they are balanced: mostly magenta; the only exact way back
};

/// What may be asked for beside a photo and a reference.
struct Options {
    std::string model;                    ///< name, or path of a .safetensors file; empty: the known one that
                                          ///< has the name and hash in `parameters`, else "default"
    std::optional<Parameters> parameters; ///< in place of selected ones (reverse) or recorded ones (forward)
    InputEncoding input = InputEncoding::automatic;
    Precision precision = Precision::float32;
    GainMapUse gain_map = GainMapUse::ignore;
    bool allow_partial = false;  ///< a photo that breaks off is taken as far as it goes, with a note
    bool straight_alpha = false; ///< colour of results is not multiplied with alpha (`oiio:UnassociatedAlpha`)
    bool isolate = true;         ///< RAW files are decoded by a program of their own (load_reference)
    int threads = 0;             ///< 0: all of OpenImageIO's threads; 1: the calling thread only
    std::uint64_t seed = 0;      ///< with the photo's name it says which of several references is taken, and which
                                 ///< brightness
    std::optional<Brightness> brightness; ///< of reverse results only

    /// The size that the photo gets before anything else is done with it: `N` pixels for its shorter side, `WxH`, `Wx0`
    /// or `0xH` (the other side by its shape), `P%`; upright; empty: its own.
    std::string resize;
    /// Of that its middle, of `N` x `N` or `WxH` pixels, or with `random:` before it a part that `seed` and the photo's
    /// name decide; empty: all.
    std::string crop;

    std::optional<Mosaic> mosaic; ///< `reference`: its phase; where that is not known RGGB, with a note
    Levels levels = Levels::unit; ///< of a mosaic
    /// Where the figures of noise to be added come from: `reference`, `iso=800`, `shot=0.01,read=1e-4` (variance =
    /// shot · value + read; one figure each, or three for R, G, B), `upi`; empty: none is added.
    std::string noise;
    std::string profile; ///< path of a noiseprofiles.json, for noise by ISO; empty: the one darktable installed
    std::uint64_t noise_seed = 0; ///< with the photo's name it says which noise

    /// The scene-linear colour space that the RAW-like image is developed into: ACEScg, ACES2065-1, lin_rec709,
    /// lin_rec2020, lin_p3d65, XYZ, or another name of theirs; empty: it stays camera RGB.
    std::string develop;
    WhiteBalance white_balance;
    double exposure = 0; ///< EV; −20 to 20
    Highlights highlights = Highlights::clip;
};

/// Sets one option by its name, as a query, a recipe and srisptool do: model, params (the path of a JSON file), input
/// (auto, srgb, linear), precision (float32, fast), brightness (EV, sample), seed, gainmap (ignore, apply),
/// allow_partial (0, 1), isolate (0, 1), resize, crop, mosaic (reference, RGGB, …), levels (unit, camera), noise,
/// profile, noise_seed, develop, whitebalance (scene, reference, KELVIN, KELVIN,TINT, R,G,B), exposure (EV), highlights
/// (clip, blend, keep). Errors: unknown keys and values (the near ones listed), a file that cannot be read.
SRISP_API Status set_option(Options& options, const std::string& key, const std::string& value);

} // namespace srisp
