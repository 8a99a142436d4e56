// SPDX-License-Identifier: Apache-2.0
// ultra_hdr_sample FILE [iso]: writes a small photo with a gain map of 0 to 2 stops, which rise from left to right.
#include <cstdio>
#include <fstream>

#include "ultra_hdr_jpeg.h"

int main(int argc, char** argv)
{
    const bool is_iso = argc == 3 && std::string(argv[2]) == "iso";
    if (argc != 2 && !is_iso) {
        std::fputs("usage: ultra_hdr_sample FILE [iso]\n", stderr);
        return 2;
    }
    UltraHdrJpeg sample;
    sample.width = 320;
    sample.height = 240;
    sample.map_width = 80;
    sample.map_height = 60;
    if (is_iso)
        sample.map_iso = iso_segment(0x40, { 0, 1, 2, 1, 0, 1, 2, 1, 1, 1, 1, 64, 1, 64 });
    sample.map_has_xmp = !is_iso;
    std::ofstream file(argv[1], std::ios::binary);
    file << sample.bytes() << std::flush;
    return file ? 0 : 1;
}
