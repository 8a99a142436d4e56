// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace srisp {

/// A number that looks random and depends on seed and text alone: the same on every machine and library, which
/// std::hash and the distributions of <random> do not promise. (FNV-1a, then SplitMix64.)
std::uint64_t seeded_hash(std::uint64_t seed, const std::string& text);

} // namespace srisp
