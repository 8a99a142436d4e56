// SPDX-License-Identifier: Apache-2.0
// Where the time of a training step goes, against the multiply-add peak of this machine, all in one run.
#include <algorithm>
#include <cstdio>
#include <map>

#include <CLI/CLI.hpp>

#include "fma_peak.h"
#include "measuring.h"
#include "pack/training_pack.h"
#include "train/learning/losses.h"
#include "train/learning/optimizer.h"
#include "train/run/model_file.h"
#include "train/samples/sample_maker.h"
#include "train/tensors/torch_api.h"

using namespace srisp::train;

namespace {

// Multiply-adds per pixel of the tone map's four layers [method 2], 3×3.
constexpr double kToneMap = 20160;

struct Settings {
    int pairs = 24, unpaired = 12, size = 64, threads = 2, steps = 8;
    std::string pack;
    ModelSettings model;
};

/// Seconds of each part of the step that was fastest.
using Parts = std::map<std::string, double>;

double total(const Parts& parts)
{
    double sum = 0;
    for (const auto& [name, part] : parts)
        sum += part;
    return sum;
}

/// Noise stands in where there is no pack: the arithmetic takes as long.
Batch noise(const Settings& settings)
{
    const auto images = [&](int count, double high) {
        return torch::rand({ count, 3, settings.size, settings.size }) * high;
    };
    return { images(settings.pairs, 1), images(settings.pairs, 0.5), images(settings.pairs, 0.5),
             images(settings.unpaired, 1), images(settings.unpaired, 0.5) };
}

std::unique_ptr<Samples> samples_of(const Settings& settings)
{
    if (settings.pack.empty())
        return {};
    srisp::Expected<std::shared_ptr<const srisp::TrainingPack>> pack = srisp::TrainingPack::open(settings.pack);
    if (!pack)
        throw std::runtime_error(pack.error().message);
    DataSettings data;
    data.image_size = settings.size;
    srisp::Expected<std::unique_ptr<Samples>> samples = make_samples(data, *pack, 1);
    if (!samples)
        throw std::runtime_error(samples.error().message);
    return std::move(*samples);
}

class Bench {
public:
    explicit Bench(const Settings& settings)
        : m_settings(settings), m_samples(samples_of(settings)), m_student(make_unprocessor(settings.model, 1)),
          m_teacher(make_unprocessor(settings.model, 1)), m_parameters(*m_student),
          m_average(m_parameters.values().clone()),
          m_adam({}, m_parameters, m_parameters.mask_of(m_student->dictionary_parameters()),
                 torch::zeros_like(m_parameters.values()))
    {
    }

    /// One step as the trainer makes it.
    Parts step(int number)
    {
        Parts parts;
        Batch batch;
        ChosenParameters choice;
        torch::Tensor estimate, loss;
        Compared images;
        parts["1 data"] = seconds([&] { batch = next_batch(number); });
        parts["2 teacher"] = seconds([&] {
            const torch::NoGradGuard no_gradient;
            estimate = m_teacher->reverse(batch.unpaired_source, batch.unpaired_reference);
            images.source = torch::cat({ batch.source, batch.unpaired_source });
            images.truth = torch::cat({ batch.truth, estimate });
            batch.reference = torch::cat({ batch.reference, estimate });
        });
        parts["3 reverse"] =
            seconds([&] { images.predicted = m_student->reverse(images.source, batch.reference, &choice); });
        parts["4 forward"] = seconds([&] { images.processed = m_student->process(images.truth, choice); });
        parts["5 loss"] = seconds([&] {
            for (const LossTerm& term : loss_terms({}, images)) {
                const torch::Tensor value = term.weight * term.values.mean();
                loss = loss.defined() ? loss + value : value;
            }
        });
        parts["6 backward"] = seconds([&] {
            m_parameters.gradients().zero_();
            loss.backward();
        });
        parts["7 optimiser"] = seconds([&] {
            m_adam.update(number, 1, m_adam.gradient_norm());
            m_student->constrain();
            const torch::NoGradGuard no_gradient;
            m_average.lerp_(m_parameters.values(), 0.005);
        });
        return parts;
    }

private:
    Batch next_batch(int number)
    {
        return m_samples ? m_samples->batch(number, 0, m_settings.pairs, 0, m_settings.unpaired) : noise(m_settings);
    }

    Settings m_settings;
    std::unique_ptr<Samples> m_samples;
    std::shared_ptr<Unprocessor> m_student, m_teacher;
    ParameterVector m_parameters;
    torch::Tensor m_average;
    Adam m_adam;
};

void report(const Settings& settings, const Parts& parts, double peak)
{
    const double all = total(parts), pixels = double(settings.size) * settings.size;
    // Each pass is computed once, and its gradients to inputs and to weights cost as much again each; the teacher's
    // reverse pass has none.
    const double work = kToneMap * pixels * (6.0 * (settings.pairs + settings.unpaired) + settings.unpaired);
    std::printf("%d + %d images of %d², %d threads: %.0f ms per step, the fastest of %d\n", settings.pairs,
                settings.unpaired, settings.size, settings.threads, all * 1e3, settings.steps);
    for (const auto& [name, part] : parts)
        std::printf("  %-12s %7.1f ms %5.1f %%\n", name.c_str() + 2, part * 1e3, 100 * part / all);
    if (settings.model.kernel_size == "3" && settings.model.method == "srisp")
        std::printf("the tone map's multiply-adds alone would take %.0f ms at the FMA peak of %.1f G/s: %.0f %% of the "
                    "step\n",
                    work / peak * 1e3, peak / 1e9, 100 * work / peak / all);
    std::printf("peak memory %.0f MB\n", memory_mb("VmHWM:"));
}

void run(const Settings& settings)
{
    set_up_process(settings.threads);
    const double peak_before = measure_fma_peak(settings.threads);
    Bench bench(settings);
    Parts best;
    for (int i = 0; i < settings.steps; ++i) {
        const Parts parts = bench.step(i);
        if (best.empty() || total(parts) < total(best))
            best = parts;
    }
    // The machine's speed may drift: the peak is taken on both sides of what is compared with it.
    report(settings, best, (peak_before + measure_fma_peak(settings.threads)) / 2);
}

} // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{ "Measures where the time of a training step goes." };
    app.add_option("--pairs", settings.pairs, "pseudo pairs per step")
        ->capture_default_str()
        ->check(CLI::Range(1, 4096));
    app.add_option("--unpaired", settings.unpaired, "photos of the mean teacher")
        ->capture_default_str()
        ->check(CLI::Range(1, 4096));
    app.add_option("--size", settings.size, "image side, px")->capture_default_str()->check(CLI::Range(16, 1024));
    app.add_option("--threads", settings.threads)->capture_default_str()->check(CLI::Range(1, 1024));
    app.add_option("--steps", settings.steps)->capture_default_str()->check(CLI::Range(1, 100000));
    app.add_option("--pack", settings.pack, "training pack to make samples from; without one: noise");
    app.add_option("--method", settings.model.method, "srisp, mbispld or unet")
        ->capture_default_str()
        ->check(CLI::IsMember({ "srisp", "mbispld", "unet" }));
    app.add_option("--kernel-size", settings.model.kernel_size)
        ->capture_default_str()
        ->check(CLI::IsMember({ "3", "1" }));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        run(settings);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "trainbench: %s\n", error.what());
        return 1;
    }
    return 0;
}
