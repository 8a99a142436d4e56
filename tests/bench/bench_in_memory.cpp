// SPDX-License-Identifier: Apache-2.0
#include <srisp/srisp.h>

#include "bench_fixture.h"
#include "measuring.h"
#include "require.h"

using namespace srisp;

/// One call for a small photo in memory; bench_python.py holds Python's against it.
BenchLines bench_in_memory(const BenchSettings& settings)
{
    if (settings.reference.empty())
        return {};
    constexpr int kCalls = 40, kWidth = 640, kHeight = 480;
    const Picture picture = bench_picture(settings, kWidth, kHeight);
    std::vector<unsigned char> codes(picture.rgb.size());
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = static_cast<unsigned char>(picture.rgb[i] * 255 + 0.5f);
    MemoryImage photo;
    photo.spec = OIIO::ImageSpec(kWidth, kHeight, 3, OIIO::TypeUInt8);
    photo.pixels = codes.data();
    const auto reference = require(load_reference(settings.reference));
    Options options;
    options.model = settings.model;
    options.threads = settings.threads;
    std::vector<double> ms;
    for (int i = 0; i < kCalls; ++i)
        ms.push_back(seconds([&] { require(unprocess(photo, reference, options)); }) * 1e3);
    return { { "in_memory", median(ms), "ms", "", "unprocess() of 640 x 480 values of 8 bits in memory" } };
}
