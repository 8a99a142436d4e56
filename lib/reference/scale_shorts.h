// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace srisp {

/// target[i] = clamp01((source[i] − black[i]) · factor[i]), `count` values: what most of the time goes into when a
/// mosaic of many megapixels is reduced. Vectorised, dispatched at run time; the same bits on every instruction set.
void scale_shorts(const std::uint16_t* source, const float* black, const float* factor, std::size_t count,
                  float* target);

} // namespace srisp
