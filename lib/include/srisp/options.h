// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// What may be asked for beside a photo and a reference.
struct Options {
    std::string model;                    ///< name, or path of a .safetensors file; empty: the known one that
                                          ///< has the name and hash in `parameters`, else "default"
    std::optional<Parameters> parameters; ///< in place of selected ones (reverse) or recorded ones (forward)
    InputEncoding input = InputEncoding::automatic;
    Precision precision = Precision::float32;
    GainMapUse gain_map = GainMapUse::ignore;
    bool allow_partial = false; ///< a photo that breaks off is taken as far as it goes, with a note
    bool isolate = true;        ///< RAW files are decoded by a program of their own (load_reference)
    std::uint64_t seed = 0;     ///< with the photo's name it says which of several references is taken, and which
                                ///< brightness
    std::optional<Brightness> brightness; ///< of reverse results only

    std::optional<Mosaic> mosaic; ///< `reference`: its phase; where that is not known RGGB, with a note
    Levels levels = Levels::unit; ///< of a mosaic
    /// Where the figures of noise to be added come from: `reference`, `iso=800`, `shot=0.01,read=1e-4` (variance =
    /// shot · value + read; one figure each, or three for R, G, B), `upi`; empty: none is added.
    std::string noise;
    std::string profile; ///< path of a noiseprofiles.json, for noise by ISO; empty: the one darktable installed
    std::uint64_t noise_seed = 0; ///< with the photo's name it says which noise
};

/// Sets one option by its name, as a query, a recipe and srisptool do: model, params (the path of a JSON file), input
/// (auto, srgb, linear), precision (float32, fast), brightness (EV, sample), seed, gainmap (ignore, apply),
/// allow_partial (0, 1), isolate (0, 1), mosaic (reference, RGGB, …), levels (unit, camera), noise, profile,
/// noise_seed. Errors: unknown keys and values (the near ones listed), a file that cannot be read.
SRISP_API Status set_option(Options& options, const std::string& key, const std::string& value);

} // namespace srisp
