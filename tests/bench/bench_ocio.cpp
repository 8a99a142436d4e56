// SPDX-License-Identifier: Apache-2.0
#include <srisp/ocio_transform.h>

#include "bench_fixture.h"
#include "measuring.h"
#include "require.h"

namespace OCIO = OCIO_NAMESPACE;
using namespace srisp;

namespace {

constexpr int kPixels = 1 << 20, kRounds = 5;

OCIO::ConstTransformRcPtr aces_output()
{
    auto group = OCIO::GroupTransform::Create();
    for (const char* style : { "ACEScg_to_ACES2065-1", "ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0",
                               "DISPLAY - CIE-XYZ-D65_to_sRGB" }) {
        auto builtin = OCIO::BuiltinTransform::Create();
        builtin->setStyle(style);
        group->appendTransform(builtin);
    }
    return group;
}

/// Colours in no order, from 0 to 1.
std::vector<float> colors()
{
    std::vector<float> rgb(std::size_t(3) * kPixels);
    for (std::size_t i = 0; i < rgb.size(); ++i)
        rgb[i] = static_cast<float>(std::uint32_t(i * 2654435761u) >> 8) / 16777216.0f;
    return rgb;
}

/// One processor and its best time so far.
struct Timed {
    OCIO::ConstCPUProcessorRcPtr processor;
    double best_s = 1e9;

    explicit Timed(const OCIO::ConstTransformRcPtr& transform)
        : processor(OCIO::Config::CreateRaw()->getProcessor(transform)->getDefaultCPUProcessor())
    {
    }
    void run(std::vector<float> rgb)
    {
        OCIO::PackedImageDesc image(rgb.data(), kPixels, 1, 3);
        best_s = std::min(best_s, seconds([&] { processor->apply(image); }));
    }
    double ns() const { return best_s * 1e9 / kPixels; }
};

/// "N ns per pixel; an ACES SDR output transform takes M"
std::string against(const Timed& timed, const Timed& aces)
{
    return digits(timed.ns(), 0) + " ns per pixel, one core; an ACES SDR output transform takes " +
           digits(aces.ns(), 0);
}

} // namespace

/// OpenColorIO's CPU processor, default optimisation: the default model's two directions and an ACES 1.0 SDR output
/// transform (ACEScg to sRGB), in turns, the best of each.
BenchLines bench_ocio(const BenchSettings& settings)
{
    BenchSettings baked = settings;
    baked.model = "default";
    const BenchFixture fixture(baked);
    const auto timed = [&](Direction direction) {
        return Timed(require(make_ocio_transform(*fixture.model, fixture.parameters, direction)));
    };
    Timed aces(aces_output()), unprocess = timed(Direction::reverse), process = timed(Direction::forward);
    const std::vector<float> rgb = colors();
    for (int round = 0; round < kRounds; ++round)
        for (Timed* each : { &aces, &unprocess, &process })
            each->run(rgb);
    return { { "ocio_unprocess", unprocess.ns() / aces.ns(), "of ACES", "<= 1.3", against(unprocess, aces) },
             { "ocio_process", process.ns() / aces.ns(), "of ACES", "<= 1.3", against(process, aces) } };
}
