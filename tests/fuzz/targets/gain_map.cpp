// SPDX-License-Identifier: Apache-2.0
// Gain maps: of a JPEG photo, applied; and the metadata alone.
#include "gain_map/gain_map.h"

#include <cmath>

#include "fuzz_target.h"
#include "jpeg/jpeg_segments.h"

using namespace srisp;

namespace {

constexpr int kWidth = 32, kHeight = 24;

void check_boost(const GainMapInfo& info)
{
    const auto map = GainMap::create(info, kWidth, kHeight);
    if (!fuzz::is_accepted(map))
        return;
    std::vector<float> row(3 * kWidth);
    for (int y = 0; y < kHeight; ++y) {
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = float(i) / float(row.size());
        map->boosted(y, row.data(), row.data());
        for (const float value : row)
            fuzz::must_hold(std::isfinite(value), "boosted values are finite");
    }
}

void check_metadata(std::string_view bytes)
{
    fuzz::is_accepted(gain_map_metadata_from_iso(bytes));
    if (const auto xmp = XmpPacket::parse(bytes))
        fuzz::is_accepted(gain_map_metadata_from_xmp(*xmp));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    // An allocation of the exact size, so that a sanitizer sees every read beyond it.
    const std::vector<char> exact(data, data + size);
    const std::string_view bytes(exact.data(), exact.size());
    check_metadata(bytes);
    if (const auto frame = find_jpeg_frame(bytes))
        fuzz::must_hold(frame->width >= 0 && frame->height >= 0, "a frame has sizes");
    if (const auto end = jpeg_image_size(bytes))
        fuzz::must_hold(*end <= size, "an image ends within the file");
    const auto info = find_gain_map(bytes);
    if (fuzz::is_accepted(info) && *info)
        check_boost(**info);
    return 0;
}
