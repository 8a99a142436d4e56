// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>
#include <srisp/export.h>

namespace srisp {

enum class Direction {
    reverse, ///< display-encoded sRGB → RAW-like camera RGB ("unprocess")
    forward  ///< RAW-like camera RGB → display-encoded sRGB ("process")
};

/// How the tone map of 3×3 kernels is computed; other blocks and kernels are the same in both.
enum class Precision {
    float32, ///< plain sums in float32
    fast ///< by bf16 where the processor has AVX-512 BF16: on photos within 1e-3 of the above, some 1e-5 on average;
         ///< elsewhere with fewer multiply-adds in float32: within 1e-4, 1e-6 on average
};

/// Reads "float32" or "fast"; an error names both.
SRISP_API Expected<Precision> precision_from_name(const std::string& name);

/// How the stored colour values of an image are to be read.
enum class InputEncoding {
    automatic, ///< what the image says: colour-space name, then ICC profile, then the type (float EXR is "Linear")
    srgb,      ///< display-encoded sRGB, whatever else the image says
    linear,    ///< linear light with sRGB primaries; encoded with the sRGB curve
    camera     ///< a RAW-like image, to be processed forward: values are taken as they are
};

/// Reads "auto", "srgb" or "linear"; an error names all three.
SRISP_API Expected<InputEncoding> input_encoding_from_name(const std::string& name);

} // namespace srisp
