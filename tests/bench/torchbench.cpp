// SPDX-License-Identifier: Apache-2.0
// How long LibTorch takes for the reverse pass: what srispbench compares apply with.
#include <cstdio>
#include <exception>

#include <ATen/Parallel.h>
#include <CLI/CLI.hpp>

#include "measuring.h"
#include "train/network/pipeline.h"
#include "train/run/model_file.h"
#include "train/tensors/torch_api.h"

using namespace srisp::train;

/// As anyone would write it: the trainer's own form is arranged such that LibTorch is fast.
static torch::Tensor plain_tone_map(const torch::Tensor& image, const ChosenParameters& choice)
{
    torch::Tensor x = image;
    for (std::size_t l = 0; l < choice.tone_reverse_weight.size(); ++l) {
        x = torch::conv2d(torch::replication_pad2d(x, { 1, 1, 1, 1 }), choice.tone_reverse_weight[l][0],
                          choice.tone_reverse_bias[l][0]);
        if (l + 1 < choice.tone_reverse_weight.size())
            x = torch::relu(x);
    }
    return (image + x).clamp(0, 1);
}

int main(int argc, char** argv)
{
    double megapixels = 6;
    bool tuned = false;
    CLI::App app{ "Prints the nanoseconds per pixel that LibTorch takes for the reverse pass of a spatial model.\n"
                  "Threads: OMP_NUM_THREADS." };
    app.add_option("--megapixels", megapixels)->capture_default_str()->check(CLI::Range(0.01, 100.0));
    app.add_flag("--tuned", tuned, "as the trainer does it: memory kept, wider last layer, borders in place");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        if (tuned)
            set_up_process(at::get_num_threads());
        const torch::NoGradGuard no_gradient;
        const std::shared_ptr<Unprocessor> network = make_unprocessor(ModelSettings(), 1);
        const torch::Tensor thumbnail = torch::rand({ 1, 3, 64, 64 });
        ChosenParameters choice;
        network->reverse(thumbnail, thumbnail, &choice);
        const std::int64_t width = 3000, height = static_cast<std::int64_t>(megapixels * 1e6 / width);
        const torch::Tensor image = torch::rand({ 1, 3, height, width });
        const double time = seconds([&] {
            if (tuned) {
                network->apply_reverse(image, choice);
                return;
            }
            ChosenParameters rest = choice;
            rest.tone_reverse_weight.clear();
            reverse_pipeline(plain_tone_map(image, choice), rest);
        });
        std::printf("%.1f\n", time * 1e9 / (width * height));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "torchbench: %s\n", error.what());
        return 1;
    }
    return 0;
}
