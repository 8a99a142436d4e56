// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "model/safetensors.h"
#include "scratch_folder.h"

/// A small generator with the same numbers on every machine (splitmix64).
class Random {
public:
    explicit Random(std::uint64_t seed) : m_state(seed) {}

    std::uint64_t next()
    {
        std::uint64_t z = m_state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    float uniform(float low, float high) { return low + (high - low) * static_cast<float>(next() >> 40) / 16777216.0f; }
    int below(int limit) { return static_cast<int>(next() % static_cast<std::uint64_t>(limit)); }

private:
    std::uint64_t m_state;
};

/// Values from −1 to 1.
std::vector<float> random_values(Random& random, std::size_t count);

/// A model of the `srisp-1` format with random values, to be broken by tests and written to a file.
struct ModelFile {
    std::map<std::string, std::string> metadata;
    std::map<std::string, srisp::Tensor> tensors;
    std::string type = "F32"; ///< F32, F16 or BF16

    std::string bytes() const;
    /// Writes the bytes; returns `path`.
    std::string write(const std::string& path) const;
};

ModelFile random_model(int kernel_size, std::uint64_t seed, int dictionary_size = 5);

/// The same of the `srisp-7` format; it tells a constant deviation of the brightness.
ModelFile random_srisp_7_model(int kernel_size, std::uint64_t seed, int selection_size = 64,
                               double brightness_sd_ev = 0.5);

/// Writes a text or bytes to a file.
void write_file(const std::string& path, const std::string& bytes);
