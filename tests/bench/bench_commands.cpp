// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <sys/resource.h>

#include <OpenImageIO/imagebuf.h>

#include "../../tools/common/shell_quote.h"
#include "../../tools/common/temporary_folder.h"
#include "bench_fixture.h"
#include "measuring.h"
#include "require.h"

namespace {

/// Throws where the shell command fails.
double command_seconds(const std::string& command)
{
    return seconds([&] {
        if (std::system(command.c_str()) != 0)
            throw std::runtime_error("failed: " + command);
    });
}

/// CPU seconds of all threads of a shell command and of what it started.
double cpu_seconds(const std::string& command)
{
    const auto used = [] {
        rusage usage{};
        getrusage(RUSAGE_CHILDREN, &usage);
        return double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
               double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) * 1e-6;
    };
    const double before = used();
    command_seconds(command);
    return used() - before;
}

/// What a command costs beyond the stock one.
BenchLine cpu_line(const std::string& with, const std::string& without, double megapixels)
{
    std::vector<double> ours, stock;
    for (int i = 0; i < 5; ++i) {
        ours.push_back(cpu_seconds(with));
        stock.push_back(cpu_seconds(without));
    }
    return { "command_cpu", median(ours) / median(stock) - 1, "x", "<= 0.3",
             "CPU time of srisptool, " + digits(megapixels, 1) + " Mpx JPEG to EXR, beyond oiiotool without it (" +
                 digits(median(ours), 2) + " and " + digits(median(stock), 2) + " s)" };
}

BenchLine start_up_line(const std::string& name, const std::string& ours, const std::string& stock,
                        const std::string& what)
{
    const std::string quiet = " >/dev/null 2>&1";
    double with = 1e9, without = 1e9;
    for (int i = 0; i < 20; ++i) {
        with = std::min(with, command_seconds(ours + quiet));
        without = std::min(without, command_seconds(stock + quiet));
    }
    return { name, (with - without) * 1e3, "ms", "<= 15", what + ", " + digits(without * 1e3, 0) + " ms" };
}

} // namespace

BenchLines bench_commands(const BenchSettings& settings)
{
    if (settings.reference.empty())
        return {};
    namespace fs = std::filesystem;
    const auto shell_quoted = [](const std::string& word) { return srisp::tool::shell_line({ word }); };
    const std::string srisptool = shell_quoted(settings.bin + "/srisptool");
    const std::string plugins = shell_quoted(settings.bin + "/../lib/srisp");
    BenchLines lines{ start_up_line("start_up", srisptool + " --help", "oiiotool --help",
                                    "srisptool --help, beyond the stock oiiotool's"),
                      start_up_line("plugin_load", "OIIO_LIBRARY_PATH=" + plugins + " oiiotool --help",
                                    "oiiotool --help",
                                    "the stock oiiotool with the plugin on its path, beyond without") };

    const srisp::tool::TemporaryFolder temporary;
    const fs::path& folder = temporary.path();
    const std::string photo = shell_quoted((folder / "photo.jpg").string()),
                      out = shell_quoted((folder / "out.exr").string());
    const int height = static_cast<int>(settings.megapixels * 1e6 / 6000);
    Picture picture = bench_picture(settings, 6000, height);
    OIIO::ImageBuf image(OIIO::ImageSpec(6000, height, 3), picture.rgb.data());
    if (!image.write((folder / "photo.jpg").string(), OIIO::TypeUInt8))
        throw std::runtime_error("'" + (folder / "photo.jpg").string() + "': " + image.geterror());

    const BenchFixture fixture(settings);
    const std::string depth = " -d half -o " + out;
    const std::string ours_line = srisptool + " " + photo + " --srisp-unprocess:model=" + shell_quoted(settings.model) +
                                  " " + shell_quoted(settings.reference) + depth + " 2>/dev/null";
    const std::string stock_line = "oiiotool " + photo + depth;
    std::vector<double> ratios;
    double apply = 0, ours = 0, plain = 0;
    for (int i = 0; i < 3; ++i) {
        Picture copy = picture;
        apply = apply_seconds(*fixture.applier(), copy, settings.threads);
        ours = command_seconds(ours_line);
        plain = command_seconds(stock_line);
        ratios.push_back((ours - plain) / apply);
    }
    lines.push_back({ "whole_command", median(ratios), "x", "<= 1.25",
                      "srisptool " + digits(settings.megapixels, 1) +
                          " Mpx JPEG to EXR beyond oiiotool without it (last: " + digits(ours, 2) + " and " +
                          digits(plain, 2) + " s); base: apply, " + digits(apply, 2) + " s" });
    lines.push_back(cpu_line(ours_line, stock_line, settings.megapixels));
    return lines;
}
