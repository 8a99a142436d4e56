// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// One line of srispbench's table: a number, measured, and what it should be.
struct BenchLine {
    std::string name;   ///< short and stable: the key in JSON
    double value;       ///< in `unit`
    std::string unit;   ///< "of the peak", "ms", …
    std::string target; ///< what the project asks for; empty: nothing
    std::string detail; ///< how it was measured; the base, where it is a ratio
};

using BenchLines = std::vector<BenchLine>;

/// What all parts of the benchmark are told.
struct BenchSettings {
    std::string model = "default";
    double megapixels = 24;
    int threads = 0;   ///< main() makes 0 the number of OpenImageIO's threads
    std::string photo; ///< empty: a synthetic one
    std::string reference;
    std::string bin; ///< folder of the programs
};

BenchLines bench_apply(const BenchSettings& settings);
BenchLines bench_sizes(const BenchSettings& settings);
BenchLines bench_select(const BenchSettings& settings);
BenchLines bench_small_photos(const BenchSettings& settings);
BenchLines bench_reference(const BenchSettings& settings);
BenchLines bench_libraries(const BenchSettings& settings);
BenchLines bench_ocio(const BenchSettings& settings);
BenchLines bench_raw_out(const BenchSettings& settings);
BenchLines bench_develop(const BenchSettings& settings);
BenchLines bench_in_memory(const BenchSettings& settings);
BenchLines bench_batch(const BenchSettings& settings);
BenchLines bench_commands(const BenchSettings& settings);
