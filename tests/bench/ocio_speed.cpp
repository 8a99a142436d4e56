// SPDX-License-Identifier: Apache-2.0
#include "ocio_speed.h"

#include <cstdio>

#include <srisp/model.h>
#include <srisp/ocio_transform.h>
#include <srisp/select.h>

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

} // namespace

nlohmann::ordered_json measure_ocio(const Thumbnail& source, const Thumbnail& reference)
{
    try {
        const auto model = require(Model::load("pointwise"));
        const Parameters parameters = require(srisp::select(*model, source, reference));
        Timed aces(aces_output()), unprocess(require(make_ocio_transform(*model, parameters, Direction::reverse))),
            process(require(make_ocio_transform(*model, parameters, Direction::forward)));
        const std::vector<float> rgb = colors();
        for (int round = 0; round < kRounds; ++round)
            for (Timed* each : { &aces, &unprocess, &process })
                each->run(rgb);
        return { { "aces_sdr_output_ns", aces.ns() },
                 { "unprocess_ns", unprocess.ns() },
                 { "process_ns", process.ns() },
                 { "unprocess_of_aces", unprocess.ns() / aces.ns() },
                 { "process_of_aces", process.ns() / aces.ns() } };
    } catch (const std::exception& error) {
        std::fprintf(stderr, "srispbench: OpenColorIO: %s\n", error.what());
        std::exit(1);
    }
}

std::string ocio_line(const nlohmann::ordered_json& measured)
{
    char text[200];
    std::snprintf(text, sizeof text,
                  "OCIO    unprocess %.0f, process %.0f ns per pixel, one core: %.2f and %.2f of an ACES SDR output "
                  "transform (%.0f ns)",
                  measured["unprocess_ns"].get<double>(), measured["process_ns"].get<double>(),
                  measured["unprocess_of_aces"].get<double>(), measured["process_of_aces"].get<double>(),
                  measured["aces_sdr_output_ns"].get<double>());
    return text;
}
