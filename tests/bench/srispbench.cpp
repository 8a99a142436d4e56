// SPDX-License-Identifier: Apache-2.0
// Measures what users wait for against the limits of this machine, all in one run.
#include <cstdio>

#include <CLI/CLI.hpp>
#include <OpenImageIO/imageio.h>
#include <nlohmann/json.hpp>

#include "../../tools/common/own_location.h"
#include "bench_lines.h"

namespace {

struct Part {
    const char* name;
    BenchLines (*measure)(const BenchSettings&);
};

constexpr Part kParts[] = { { "apply", bench_apply },         { "sizes", bench_sizes },
                            { "select", bench_select },       { "small_photos", bench_small_photos },
                            { "reference", bench_reference }, { "libraries", bench_libraries },
                            { "ocio", bench_ocio },           { "raw_out", bench_raw_out },
                            { "develop", bench_develop },     { "in_memory", bench_in_memory },
                            { "batch", bench_batch },         { "commands", bench_commands } };

void print(const BenchLine& line)
{
    std::printf("%-16s %9.4g %-18s %-9s %s\n", line.name.c_str(), line.value, line.unit.c_str(), line.target.c_str(),
                line.detail.c_str());
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv)
{
    BenchSettings settings;
    std::vector<std::string> parts;
    bool json = false;
    CLI::App app{ "Measures what users wait for against the limits of this machine, all in one run." };
    std::vector<std::string> names;
    for (const Part& part : kParts)
        names.push_back(part.name);
    app.add_option("parts", parts, "what to measure; without any: all")->check(CLI::IsMember(names));
    app.add_option("--model", settings.model, "model name or file")->capture_default_str();
    app.add_option("--megapixels", settings.megapixels, "size of the image")
        ->capture_default_str()
        ->check(CLI::Range(0.01, 1000.0));
    app.add_option("--threads", settings.threads, "0: all")->capture_default_str()->check(CLI::Range(0, 1024));
    app.add_option("--photo", settings.photo, "photo to work on; without one: a synthetic picture")
        ->check(CLI::ExistingFile);
    app.add_option("--reference", settings.reference, "RAW file; without one, parts that need it are left out")
        ->check(CLI::ExistingFile);
    app.add_flag("--json", json, "print one JSON object");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (settings.threads == 0)
        settings.threads = OIIO::get_int_attribute("threads", 1);
    settings.bin = srisp::tool::own_executable().parent_path().string();
    try {
        nlohmann::ordered_json all;
        for (const Part& part : kParts) {
            if (!parts.empty() && std::find(parts.begin(), parts.end(), part.name) == parts.end())
                continue;
            for (const BenchLine& line : part.measure(settings))
                if (json)
                    all[line.name] = { { "value", line.value },
                                       { "unit", line.unit },
                                       { "target", line.target },
                                       { "detail", line.detail } };
                else
                    print(line);
        }
        if (json)
            std::printf("%s\n", all.dump(2).c_str());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "srispbench: %s\n", error.what());
        return 1;
    }
    return 0;
}
