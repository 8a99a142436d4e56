// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "bench_fixture.h"
#include "fma_peak.h"
#include "kernels/bf16_convolution.h"
#include "measuring.h"
#include "require.h"

using namespace srisp;

namespace {

constexpr int kRepeats = 3, kPointwiseRepeats = 9;
constexpr int kWidth = 6000;

/// Apply, its fast form and the peak by turns, so that a machine whose speed drifts slows all of them.
struct Rates {
    double apply_s, peak; ///< medians
    double part_of_peak;  ///< median of each turn's own
    double fast_s = 0, fast_gain = 0;
};

bool is_pointwise(const BenchFixture& fixture)
{
    return fixture.model->kernel_size() == 1;
}

Rates measure(const BenchFixture& fixture, bool with_fast, const Picture& picture, int threads)
{
    const auto applier = fixture.applier(), fast = fixture.applier(Precision::fast);
    std::vector<double> times, fast_times, gains, peaks{ measure_fma_peak(threads) }, parts;
    const double work = (is_pointwise(fixture) ? kPointwiseMultiplyAddsPerPixel : kMultiplyAddsPerPixel) *
                        picture.width * picture.height;
    for (int i = 0; i < (is_pointwise(fixture) ? kPointwiseRepeats : kRepeats); ++i) {
        Picture copy = picture;
        times.push_back(apply_seconds(*applier, copy, threads));
        peaks.push_back(measure_fma_peak(threads));
        parts.push_back(work / times.back() / ((peaks[i] + peaks[i + 1]) / 2));
        if (!with_fast)
            continue;
        copy = picture;
        fast_times.push_back(apply_seconds(*fast, copy, threads));
        gains.push_back(times.back() / fast_times.back());
    }
    Rates rates{ median(times), median(peaks), median(parts) };
    if (with_fast)
        rates.fast_s = median(fast_times), rates.fast_gain = median(gains);
    return rates;
}

BenchLine memory_line(const Applier& applier, const BenchSettings& settings)
{
    const int height = static_cast<int>(settings.megapixels * 1e6 / kWidth);
    Picture picture = bench_picture(settings, kWidth, height);
    const double before_mb = memory_mb("VmRSS:");
    reset_peak_memory();
    apply_seconds(applier, picture, settings.threads);
    return { "apply_memory", memory_mb("VmHWM:") - before_mb, "MB", "<= 150",
             "beyond the image of " + digits(settings.megapixels, 1) + " Mpx, in place" };
}

/// What Precision::fast is for the model, on the instruction set in use.
std::string fast_method(const BenchFixture& fixture)
{
    return is_pointwise(fixture) ? "a table" : has_bf16() ? "bf16" : "minimal filtering";
}

BenchLine error_line(const BenchFixture& fixture, const BenchSettings& settings, const std::string& suffix)
{
    const Picture source = bench_picture(settings, 2000, 1500);
    Picture plain = source, fast = source;
    apply_seconds(*fixture.applier(), plain, settings.threads);
    apply_seconds(*fixture.applier(Precision::fast), fast, settings.threads);
    double sum = 0, largest = 0;
    for (std::size_t i = 0; i < plain.rgb.size(); ++i) {
        const double error = std::abs(double(plain.rgb[i]) - fast.rgb[i]);
        sum += error;
        largest = std::max(largest, error);
    }
    return { "fast_error" + suffix, sum / plain.rgb.size() * 1023, "10-bit codes", "< 1",
             "mean difference from float32 on " + (settings.photo.empty() ? "a synthetic picture" : settings.photo) +
                 ", largest " + digits(largest * 1023, 4) + "; " + fast_method(fixture) };
}

BenchLine denormal_line(const Applier& applier, const BenchSettings& settings)
{
    const Picture normal = bench_picture(settings, 1000, 1000);
    Picture tiny(1000, 1000);
    std::fill(tiny.rgb.begin(), tiny.rgb.end(), 1e-40f);
    std::vector<double> ratios;
    for (int i = 0; i < kRepeats; ++i) {
        Picture a = normal, b = tiny;
        const double base = apply_seconds(applier, a, settings.threads);
        ratios.push_back(apply_seconds(applier, b, settings.threads) / base);
    }
    return { "denormals", median(ratios), "x", "about 1", "time for an image of 1e-40, base: an ordinary one" };
}

/// The peak, apply and its fast form on the instruction set in use; `suffix`: of the lines' names.
void add_rates(BenchLines& lines, const BenchFixture& fixture, const Picture& picture, const BenchSettings& settings,
               const std::string& suffix)
{
    const Rates rates = measure(fixture, true, picture, settings.threads);
    const std::string size = digits(settings.megapixels, 1) + " Mpx in place, " + std::to_string(settings.threads) +
                             (settings.threads == 1 ? " thread" : " threads");
    const std::string set = instruction_set(), model = "model " + fixture.model->name();
    lines.push_back({ "peak" + suffix, rates.peak / 1e9, "G multiply-adds/s", "", "float32 FMA, " + set });
    lines.push_back({ "apply" + suffix, 100 * rates.part_of_peak, "% of the peak",
                      is_pointwise(fixture) ? ">= 60" : ">= 75",
                      model + ", " + size + ", " + digits(rates.apply_s, 2) + " s, " + set });
    lines.push_back(
        { "fast" + suffix, rates.fast_gain, "x", is_pointwise(fixture) ? ">= 2" : ">= 1.7",
          "precision fast (" + fast_method(fixture) + "), " + digits(rates.fast_s, 2) + " s; base: float32" });
    lines.push_back(error_line(fixture, settings, suffix));
}

/// On all that the processor has, and without AVX-512.
void add_all_rates(BenchLines& lines, const BenchFixture& fixture, const Picture& picture,
                   const BenchSettings& settings, const std::string& suffix)
{
    add_rates(lines, fixture, picture, settings, suffix);
    if (!has_avx512())
        return;
    const WithoutAvx512 forced;
    add_rates(lines, fixture, picture, settings, suffix + "_avx2");
}

/// Another installed model, whose tone map has kernels of another size; empty where there is none.
std::string other_model(const Model& model)
{
    for (const std::string& name : Model::available())
        if (require(Model::load(name))->kernel_size() != model.kernel_size())
            return name;
    return {};
}

} // namespace

BenchLines bench_apply(const BenchSettings& settings)
{
    const BenchFixture fixture(settings);
    const auto applier = fixture.applier();
    const int height = std::max(1, static_cast<int>(settings.megapixels * 1e6 / kWidth));
    const Picture picture = bench_picture(settings, kWidth, height);
    BenchLines lines;
    add_all_rates(lines, fixture, picture, settings, "");
    if (const std::string other = other_model(*fixture.model); !other.empty()) {
        BenchSettings others = settings;
        others.model = other;
        add_all_rates(lines, BenchFixture(others), picture, settings, "_" + other);
    }
    lines.push_back(memory_line(*applier, settings));
    lines.push_back(denormal_line(*applier, settings));
    if (settings.threads > 1) {
        const Picture part = bench_picture(settings, kWidth, std::min(height, 500));
        const Rates one = measure(fixture, false, part, 1), all = measure(fixture, false, part, settings.threads);
        lines.push_back({ "scaling", all.part_of_peak / one.part_of_peak, "x", ">= 0.95",
                          "gain from 1 to " + std::to_string(settings.threads) +
                              " threads; base: the peak loop's own gain, " + digits(all.peak / one.peak, 2) });
    }
    return lines;
}

BenchLines bench_sizes(const BenchSettings& settings)
{
    const BenchFixture fixture(settings);
    const auto applier = fixture.applier();
    const auto ns_per_pixel = [&](int width, int height) {
        const Picture picture = bench_picture(settings, width, height);
        std::vector<double> times;
        double spent = 0;
        for (int i = 0; i < kRepeats || spent < 0.3; ++i) {
            Picture copy = picture;
            times.push_back(apply_seconds(*applier, copy, settings.threads));
            spent += times.back();
        }
        return median(times) * 1e9 / width / height;
    };
    BenchLines lines;
    for (const auto& [width, height] : { std::pair(640, 480),
                                         { 1000, 1000 },
                                         { 4000, 3000 },
                                         { 20000, 16 },
                                         { 16, 20000 },
                                         { 10000, 1 },
                                         { 1, 10000 },
                                         { 1, 1 } }) {
        const double base = ns_per_pixel(2000, 1500);
        lines.push_back({ "size_" + std::to_string(width) + "x" + std::to_string(height),
                          ns_per_pixel(width, height) / base, "x",
                          width * height >= 300000 && height > 16 ? "<= 1.2" : "",
                          "time per pixel; base: 2000 × 1500, " + digits(base, 0) + " ns" });
    }
    return lines;
}
