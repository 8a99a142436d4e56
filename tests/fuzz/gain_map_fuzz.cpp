// SPDX-License-Identifier: Apache-2.0
// Damages JPEGs with gain maps at random (same seed, same damage), and looks for the map and applies it: the outcome is
// finite values, no map, or an error, in bounded time and memory. Most useful with SRISP_SANITIZE. Usage:
// gain_map_fuzz [rounds] [seed] [file…]; files are damaged as well as those made here.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "gain_map/gain_map.h"
#include "ultra_hdr_jpeg.h"

using namespace srisp;

namespace {

constexpr int kWidth = 32, kHeight = 24;

std::vector<std::string> seeds_of_kind()
{
    UltraHdrJpeg plain, colors, iso, index_only, container_only;
    colors.map_channels = 3;
    colors.map_elements = "<hdrgm:Gamma><rdf:Seq><rdf:li>1</rdf:li><rdf:li>2</rdf:li><rdf:li>3</rdf:li></rdf:Seq>"
                          "</hdrgm:Gamma>";
    iso.map_iso = iso_segment(0x40, { 0, 1, 2, 1, 0, 1, 2, 1, 1, 1, 1, 64, 1, 64 });
    iso.map_has_xmp = false;
    index_only.has_container = false;
    index_only.big_endian = false;
    container_only.has_index = false;
    return { plain.bytes(), colors.bytes(), iso.bytes(), index_only.bytes(), container_only.bytes() };
}

/// A few bytes set to values that tend to break parsers; or the end cut off.
std::string damaged(std::string bytes, std::mt19937& random)
{
    static const unsigned char kValues[] = { 0, 1, 2, 0x7f, 0x80, 0xff, '"', '<', '-', 'e' };
    const int count = 1 + int(random() % 4);
    for (int i = 0; i < count; ++i)
        bytes[random() % bytes.size()] = random() % 2 ? char(kValues[random() % sizeof kValues]) : char(random());
    if (random() % 8 == 0)
        bytes.resize(1 + random() % bytes.size());
    return bytes;
}

/// False if a value is not finite, or an error has no message.
bool is_survived(const std::string& bytes, int& applied)
{
    // An allocation of the exact size, so that a sanitizer sees every read beyond it.
    const std::vector<char> exact(bytes.begin(), bytes.end());
    const auto info = find_gain_map({ exact.data(), exact.size() });
    if (!info)
        return !info.error().message.empty();
    if (!*info)
        return true;
    const auto map = GainMap::create(**info, kWidth, kHeight);
    if (!map)
        return !map.error().message.empty();
    ++applied;
    std::vector<float> row(3 * kWidth);
    for (int y = 0; y < kHeight; ++y) {
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = float(i) / float(row.size());
        map->boosted(y, row.data(), row.data());
        for (const float value : row)
            if (!std::isfinite(value))
                return false;
    }
    return true;
}

} // namespace

int main(int argc, char** argv)
{
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 3000;
    std::mt19937 random(argc > 2 ? unsigned(std::atoi(argv[2])) : 1);
    std::vector<std::string> seeds = seeds_of_kind();
    for (int i = 3; i < argc; ++i) {
        std::ifstream in(argv[i], std::ios::binary);
        seeds.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    }
    int applied = 0;
    for (int round = 0; round < rounds; ++round)
        if (!is_survived(damaged(seeds[std::size_t(round) % seeds.size()], random), applied)) {
            std::fprintf(stderr, "round %d: a value is not finite, or an error has no message\n", round);
            return 1;
        }
    std::printf("%d damaged files: %d maps applied, %d none or refused\n", rounds, applied, rounds - applied);
    return applied > 0 && applied < rounds ? 0 : 1;
}
