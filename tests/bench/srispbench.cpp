// SPDX-License-Identifier: Apache-2.0
// Measures apply and select against the multiply-add peak of this machine, all in one run.
#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>
#include <OpenImageIO/imageio.h>
#include <nlohmann/json.hpp>
#include <srisp/apply.h>
#include <srisp/model.h>
#include <srisp/select.h>

#include "fma_peak.h"
#include "measuring.h"
#include "ocio_speed.h"

using namespace srisp;

namespace {

constexpr double kMultiplyAddsPerPixel = 20160; // the four layers of the spatial tone map [method 2]

struct Settings {
    std::string model = "default";
    double megapixels = 24;
    int threads = 0;
    bool json = false;
};

template<class T> T require(Expected<T> result)
{
    if (result)
        return *result;
    std::fprintf(stderr, "srispbench: %s\n", result.error().message.c_str());
    std::exit(1);
}

/// Smooth in places and busy in others, like a photo.
void fill(float* values, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i)
        values[i] = static_cast<float>((i / 3 * 2654435761u % 1000 + i % 4096) / 5095.0);
}

nlohmann::ordered_json measure(const Settings& settings)
{
    const int threads = settings.threads > 0 ? settings.threads : OIIO::get_int_attribute("threads");
    const std::shared_ptr<const Model> model = require(Model::load(settings.model));
    Thumbnail source, reference;
    fill(source.rgb.data(), source.rgb.size());
    fill(reference.rgb.data(), reference.rgb.size());
    Parameters parameters;
    double select_s = 1e9;
    for (int i = 0; i < 5; ++i)
        select_s = std::min(select_s, seconds([&] { parameters = require(select(*model, source, reference)); }));
    const auto applier = require(Applier::create(*model, parameters, Direction::reverse));

    const int width = 6000, height = std::max(1, static_cast<int>(settings.megapixels * 1e6 / width));
    std::vector<float> image(std::size_t(3) * width * height);
    fill(image.data(), image.size());
    const MutableImageView view{ image.data(), width, height, 3, std::ptrdiff_t(3) * width };
    const double before_mb = memory_mb("VmRSS:");
    const double peak_before = measure_fma_peak(threads);
    ApplyOptions options;
    options.threads = threads;
    Status status;
    const double apply_s = seconds([&] { status = applier->run(view, view, options); });
    if (!status) {
        std::fprintf(stderr, "srispbench: %s\n", status.error().message.c_str());
        std::exit(1);
    }
    // The machine's speed may drift: the peak is taken on both sides of what is compared with it.
    const double peak = (peak_before + measure_fma_peak(threads)) / 2;
    const double work = kMultiplyAddsPerPixel * width * height;
    return { { "instruction_set", instruction_set() },
             { "threads", threads },
             { "megapixels", double(width) * height / 1e6 },
             { "peak_gmac_per_s", peak / 1e9 },
             { "apply_s", apply_s },
             { "apply_gmac_per_s", work / apply_s / 1e9 },
             { "apply_part_of_peak", work / apply_s / peak },
             { "apply_memory_beyond_image_mb", memory_mb("VmHWM:") - before_mb },
             { "select_ms", select_s * 1e3 },
             { "ocio", measure_ocio(source, reference) } };
}

} // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{ "Measures apply and select against the multiply-add peak of this machine." };
    app.add_option("--model", settings.model, "model name or file")->capture_default_str();
    app.add_option("--megapixels", settings.megapixels, "size of the image")
        ->capture_default_str()
        ->check(CLI::Range(0.01, 1000.0));
    app.add_option("--threads", settings.threads, "0: all")->capture_default_str()->check(CLI::Range(0, 1024));
    app.add_flag("--json", settings.json, "print one JSON object");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    const nlohmann::ordered_json result = measure(settings);
    if (settings.json) {
        std::printf("%s\n", result.dump(2).c_str());
        return 0;
    }
    std::printf("%s, %d threads, %.1f Mpx in memory, in place\n", instruction_set(), result["threads"].get<int>(),
                result["megapixels"].get<double>());
    std::printf(
        "apply   %6.2f s   %6.1f of %6.1f G multiply-adds/s: %.0f %% of the FMA peak   %.0f MB beyond the image\n",
        result["apply_s"].get<double>(), result["apply_gmac_per_s"].get<double>(),
        result["peak_gmac_per_s"].get<double>(), 100 * result["apply_part_of_peak"].get<double>(),
        result["apply_memory_beyond_image_mb"].get<double>());
    std::printf("select  %6.1f ms, one core, thumbnails given\n", result["select_ms"].get<double>());
    std::printf("%s\n", ocio_line(result["ocio"]).c_str());
    return 0;
}
