// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>

#include "../../tools/common/shell_quote.h"
#include "bench_fixture.h"
#include "measuring.h"

namespace {

/// What a shell command prints. Throws where it fails.
std::string output_of(const std::string& command)
{
    std::FILE* const pipe = popen(command.c_str(), "r");
    if (!pipe)
        throw std::runtime_error("failed: " + command);
    char text[256];
    const std::string output(text, std::fread(text, 1, sizeof text, pipe));
    if (pclose(pipe) != 0)
        throw std::runtime_error("failed: " + command);
    return output;
}

/// A program that prints the nanoseconds per pixel that a library takes.
struct Library {
    const char *name, *program, *options, *target, *what;
};

constexpr Library kLibraries[] = {
    { "libtorch", "torchbench", "", ">= 12", "LibTorch eager's time" },
    { "libtorch_tuned", "torchbench", " --tuned", "", "LibTorch's as our trainer does it" },
    { "onednn", "dnnlbench", "", "", "oneDNN's for the four layers alone, in tiles without halo" },
};

} // namespace

/// Those whose programs were built, with the trainer or where the library was found.
BenchLines bench_libraries(const BenchSettings& settings)
{
    BenchSettings of_spatial = settings;
    of_spatial.model = "spatial"; // the layers that the programs compute
    const BenchFixture fixture(of_spatial);
    const auto applier = fixture.applier();
    const Picture source = bench_picture(settings, 3000, 2000);
    BenchLines lines;
    for (const Library& library : kLibraries) {
        const std::string program = settings.bin + "/" + library.program;
        if (!std::filesystem::exists(program))
            continue;
        const std::string threads = std::to_string(settings.threads);
        const std::string command = "OMP_WAIT_POLICY=passive OMP_NUM_THREADS=" + threads + " " +
                                    srisp::tool::shell_line({ program, "--megapixels", "6" }) + library.options;
        std::vector<double> ratios;
        double ours = 0;
        for (int i = 0; i < 3; ++i) {
            Picture picture = source;
            ours = apply_seconds(*applier, picture, settings.threads) * 1e9 / 6e6;
            ratios.push_back(std::stod(output_of(command)) / ours);
        }
        lines.push_back(
            { library.name, median(ratios), "x", library.target,
              library.what + (" for 6 Mpx; base: apply of the spatial model, " + digits(ours, 0)) + " ns per pixel" });
    }
    return lines;
}
