// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "base/matrix3.h"
#include "base/planes.h"

namespace srisp {

/// What goes into a power is at least this [method 1].
constexpr float kPowerFloor = 1e-8f;

/// All blocks of the pipeline but the tone map, in one direction, ready to run.
struct ColorBlocks {
    Matrix3 color;                   ///< C (forward) or its inverse (reverse)
    float exponent;                  ///< 1/γ (forward) or γ (reverse)
    float white_balance[3], gain[3]; ///< multipliers (forward) or scales 1/g (reverse)
    bool rebuilds_highlights;        ///< forward
};

// In one go over `count` pixels; planes as in pointwise.h. Vectorised, dispatched at run time.

/// What follows the tone map in the reverse pass: the power, the matrix, two inverse gains and clamp01, each as in
/// pointwise.h.
void after_tone_map(const ColorBlocks& blocks, Planes in, Planes out, std::size_t count);

/// What comes before the tone map in the forward pass: white balance and gain, then the matrix and the power.
///
/// White balance and gain are clamp01(v · g) each, the gain first. Where the gain is below 1, and the highlights
/// that the RAW has clipped are to be rebuilt, they are gain · (u + m (max(u) − u)) with
/// u = min(clamp01(v) · balance, 1 / gain), m = (clamp01((Σ min(u, 1) − 2.9) / 0.1) · b)² and
/// b = max(max(u) − 1, 0) / (1 / gain − 1). Where all channels are clipped or nearly white and the brightest shows
/// white (b = 1), all do: a gain below 1 would show how much of each was clipped. Less bright colours change less.
void before_tone_map(const ColorBlocks& blocks, Planes in, Planes out, std::size_t count);

/// The same in plain C++ with std::pow: what the vectorised forms are tested against.
namespace scalar {
void after_tone_map(const ColorBlocks& blocks, Planes in, Planes out, std::size_t count);
void before_tone_map(const ColorBlocks& blocks, Planes in, Planes out, std::size_t count);
} // namespace scalar

} // namespace srisp
