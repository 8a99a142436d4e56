// SPDX-License-Identifier: Apache-2.0
// Does unprocessing help a task? A small network learns from RAW-like images that were made of labelled photos in
// several ways, and is tested on simulated RAW images of a camera that none of them knows. docs/research/
// downstream_task.md has the results.
#include <chrono>
#include <cstdio>
#include <filesystem>

#include <CLI/CLI.hpp>

#include "model/model_files.h"
#include "require.h"
#include "task_report.h"
#include "train/run/model_file.h"

using namespace srisp::train;

namespace {

constexpr int kMargin = 8; // px by which parts are moved about

struct BenchOptions {
    std::string pack, out = "taskbench", base = "gain_match";
    std::vector<std::string> models{ "default" }, methods;
    int first_seed = 1, seeds = 5, references = 64, threads = 0;
    TaskTraining training;
    bool json = false;
};

std::string settings_text(const BenchOptions& options, const std::string& pack_hash)
{
    const TaskTraining& t = options.training;
    return nlohmann::json{
        { "pack", pack_hash },
        { "size", t.size },
        { "steps", t.steps },
        { "batch", t.batch },
        { "rate", t.rate },
        { "weight_decay", t.weight_decay },
        { "references", options.references }
    }.dump();
}

/// Methods in the order of the table: models stand between the methods that need none and the simulations.
std::vector<std::string> method_names(const BenchOptions& options)
{
    if (!options.methods.empty())
        return options.methods;
    std::vector<std::string> names{ "photo", "upi", "gain_match" };
    for (const std::string& model : options.models)
        names.push_back(srisp::model_name_of_path(model));
    names.insert(names.end(), { "simulated_others", "simulated" });
    return names;
}

TaskImages training_images(const BenchOptions& options, const TaskData& data, const std::string& method, int seed)
{
    if (method == "photo")
        return data.linearized(seed);
    if (method == "simulated")
        return data.simulated(seed);
    if (method == "simulated_others")
        return data.simulated_others(seed);
    for (const std::string& model : options.models)
        if (srisp::model_name_of_path(model) == method)
            return data.unprocessed(seed, *require(load_model(require(srisp::find_model_file(model)))).model);
    ModelSettings baseline;
    baseline.method = method;
    return data.unprocessed(seed, *make_unprocessor(baseline, seed));
}

std::string target_text(const TaskTarget& target)
{
    char light[80];
    std::snprintf(light, sizeof light, ", white balance %.2f, 1, %.2f", target.color.white_balance[0],
                  target.color.white_balance[2]);
    return target.name + light;
}

TaskResult train_and_test(const BenchOptions& options, const TaskData& data, const std::string& method, int seed,
                          const TaskImages& test)
{
    const auto start = std::chrono::steady_clock::now();
    const TaskImages images = training_images(options, data, method, seed);
    double loss = 0;
    const auto network = train_network(options.training, images, seed, [&](int step, double now) {
        loss = step == 0 ? now : 0.99 * loss + 0.01 * now;
        if ((step + 1) % 500 == 0)
            std::fprintf(stderr, "seed %d, %s: step %d, loss %.3f\n", seed, method.c_str(), step + 1, loss);
    });
    const TaskResult result{ {}, target_text(data.target(seed)), ask(*network, options.training, test) };
    std::fprintf(
        stderr, "seed %d, %s: up %.1f %%, colours %.1f %%, %.0f s (%s)\n", seed, method.c_str(),
        mean_of({ result }, nullptr, &TaskAnswers::up).mean, mean_of({ result }, nullptr, &TaskAnswers::colors).mean,
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), result.target.c_str());
    return result;
}

void run(const BenchOptions& options)
{
    set_up_process(options.threads);
    std::filesystem::create_directories(options.out);
    const auto pack = require(srisp::TrainingPack::open(options.pack));
    const TaskData data(*pack, options.training.size + kMargin, options.references);
    const std::string settings = settings_text(options, pack->hash());
    TaskResults results;
    for (const std::string& method : method_names(options))
        results.emplace_back(method, std::vector<TaskResult>());
    for (int seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed) {
        const TaskImages test = data.test(seed);
        if (seed == options.first_seed) {
            const std::vector<double> shares = color_shares(test);
            std::fprintf(stderr, "cells of the test: %.0f %% grey, %.0f %% warm, %.0f %% green, %.0f %% blue\n",
                         100 * shares[0], 100 * shares[1], 100 * shares[2], 100 * shares[3]);
        }
        for (auto& [method, of_method] : results) {
            const std::string path = result_path(options.out, seed, method);
            std::optional<TaskResult> result = read_result(path);
            if (result && result->settings != settings)
                throw std::runtime_error(path + ": made with other settings: " + result->settings);
            if (!result) {
                result = train_and_test(options, data, method, seed, test);
                result->settings = settings;
                write_result(path, *result);
            }
            of_method.push_back(*result);
        }
    }
    std::fputs(options.json ? (report_json(results, options.base).dump(2) + "\n").c_str()
                            : report_text(results, options.base).c_str(),
               stdout);
}

} // namespace

int main(int argc, char** argv)
{
    BenchOptions options;
    CLI::App app{ "Holds ways to make RAW-like images against each other by what a small network learns from them." };
    app.add_option("--pack", options.pack, "training pack with photos and cameras")->required();
    app.add_option("--models", options.models, "models: names or paths")->delimiter(',')->capture_default_str();
    app.add_option("--methods", options.methods,
                   "only these: photo, upi, gain_match, simulated_others, simulated, models")
        ->delimiter(',');
    app.add_option("--out", options.out, "folder of results; those that are there are not made again")
        ->capture_default_str();
    app.add_option("--base", options.base, "the method that the others are held against")->capture_default_str();
    app.add_option("--seeds", options.seeds)->capture_default_str()->check(CLI::Range(1, 1000));
    app.add_option("--first-seed", options.first_seed)->capture_default_str()->check(CLI::Range(1, 1000));
    app.add_option("--steps", options.training.steps)->capture_default_str()->check(CLI::Range(1, 1000000));
    app.add_option("--batch", options.training.batch)->capture_default_str()->check(CLI::Range(1, 4096));
    app.add_option("--size", options.training.size, "px that the network sees, in eights")
        ->capture_default_str()
        ->check(CLI::IsMember({ 32, 40, 48, 56, 64, 80, 96 }));
    app.add_option("--rate", options.training.rate)->capture_default_str()->check(CLI::Range(1e-6, 1.0));
    app.add_option("--weight-decay", options.training.weight_decay)->capture_default_str()->check(CLI::Range(0.0, 1.0));
    app.add_option("--references", options.references, "RAW images of the target")
        ->capture_default_str()
        ->check(CLI::Range(2, 100000));
    app.add_option("--threads", options.threads, "0: one for each processor")
        ->capture_default_str()
        ->check(CLI::Range(0, 1024));
    app.add_flag("--json", options.json, "print JSON on stdout");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        run(options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "taskbench: %s\n", error.what());
        return 1;
    }
    return 0;
}
