// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <vector>

/// A few bytes set to values that tend to break parsers, `values` among them; or the end cut off. `head`: three of four
/// such bytes lie before it.
inline std::string damaged(std::string bytes, const std::string& values, std::size_t head, std::mt19937& random)
{
    const int count = 1 + int(random() % 4);
    for (int i = 0; i < count; ++i) {
        const std::size_t range = random() % 4 == 0 ? bytes.size() : std::min(bytes.size(), head);
        char& byte = bytes[random() % range];
        byte = random() % 2 ? values[random() % values.size()] : char(random());
    }
    if (random() % 8 == 0)
        bytes.resize(1 + random() % bytes.size());
    return bytes;
}

/// How a program that damages files runs: `main [rounds] [seed] [file…]`, files beside the `seeds`.
struct FuzzRun {
    std::vector<std::string> seeds;
    std::string values;     ///< see damaged
    std::size_t head;       ///< likewise
    const char* taken;      ///< what is counted: "decoded"
    const char* broken_law; ///< what went wrong where `survives` is false
    /// Counts in its second argument what was taken.
    std::function<bool(const std::string& bytes, int& taken)> survives;

    int main(int argc, char** argv)
    {
        const int rounds = argc > 1 ? std::atoi(argv[1]) : 3000;
        std::mt19937 random(argc > 2 ? unsigned(std::atoi(argv[2])) : 1);
        for (int i = 3; i < argc; ++i) {
            std::ifstream in(argv[i], std::ios::binary);
            seeds.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
        }
        int count = 0;
        for (int round = 0; round < rounds; ++round)
            if (!survives(damaged(seeds[std::size_t(round) % seeds.size()], values, head, random), count)) {
                std::fprintf(stderr, "round %d: %s\n", round, broken_law);
                return 1;
            }
        std::printf("%d damaged files: %d %s, %d not\n", rounds, count, taken, rounds - count);
        return count > 0 && count < rounds ? 0 : 1;
    }
};
