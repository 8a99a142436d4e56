// SPDX-License-Identifier: Apache-2.0
// Damages JPEGs with gain maps at random (same seed, same damage), and looks for the map and applies it: the outcome is
// finite values, no map, or an error, in bounded time and memory. Most useful with SRISP_SANITIZE. Usage:
// gain_map_fuzz [rounds] [seed] [file…]; files are damaged as well as those made here.
#include <cmath>
#include <vector>

#include "damage.h"
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
    const std::string values("\0\1\2\x7f\x80\xff\"<-e", 10);
    return FuzzRun{
        seeds_of_kind(), values, std::string::npos, "applied", "a value is not finite, or an error has no message",
        is_survived
    }
        .main(argc, argv);
}
