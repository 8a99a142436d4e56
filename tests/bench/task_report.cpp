// SPDX-License-Identifier: Apache-2.0
#include "task_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "base/output_file.h"
#include "require.h"
#include "train/tensors/random.h"

namespace {

constexpr int kResamples = 4000;

/// The 97.5 % quantile of Student's t for 1, 2, … degrees of freedom; beyond them the normal one's, nearly.
double student(std::size_t freedom)
{
    constexpr double kQuantiles[] = { 12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
                                      2.201,  2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086 };
    return freedom <= std::size(kQuantiles) ? kQuantiles[freedom - 1] : 2.0;
}

/// Percent of right answers, or how many more than `base` has, by photo.
std::vector<double> shares(const Answers& answers, const Answers* base)
{
    std::vector<double> result;
    for (std::size_t i = 0; i < answers.right.size(); ++i) {
        result.push_back(100 * answers.right[i] / answers.asked[i]);
        if (base)
            result.back() -= 100 * base->right[i] / base->asked[i];
    }
    return result;
}

double mean(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

nlohmann::json to_json(const Answers& answers)
{
    return { { "right", answers.right }, { "asked", answers.asked } };
}

Answers answers_of(const nlohmann::json& json)
{
    return { json.at("right").get<std::vector<double>>(), json.at("asked").get<std::vector<double>>() };
}

constexpr std::pair<const char*, Answers TaskAnswers::*> kKinds[] = { { "which way is up", &TaskAnswers::up },
                                                                      { "colours", &TaskAnswers::colors } };

const std::vector<TaskResult>* find(const TaskResults& results, const std::string& method)
{
    for (const auto& [name, of_method] : results)
        if (name == method)
            return &of_method;
    return nullptr;
}

std::string text(const MeanWithInterval& value, bool difference)
{
    char line[120];
    std::snprintf(line, sizeof line, difference ? " %+6.1f ± %4.1f [%+5.1f, %+5.1f]" : " %6.1f ± %4.1f [%5.1f, %5.1f]",
                  value.mean, value.seeds, value.photos_low, value.photos_high);
    return line;
}

nlohmann::ordered_json json(const MeanWithInterval& value)
{
    return { { "mean", value.mean },
             { "seeds", value.seeds },
             { "photos_low", value.photos_low },
             { "photos_high", value.photos_high },
             { "by_seed", value.by_seed } };
}

} // namespace

std::string result_path(const std::string& folder, int seed, const std::string& method)
{
    return folder + "/" + std::to_string(seed) + "_" + method + ".json";
}

void write_result(const std::string& path, const TaskResult& result)
{
    const nlohmann::ordered_json json{ { "settings", result.settings },
                                       { "target", result.target },
                                       { "up", to_json(result.answers.up) },
                                       { "colors", to_json(result.answers.colors) } };
    require(srisp::write_output_file(path, json.dump() + "\n"));
}

std::optional<TaskResult> read_result(const std::string& path)
{
    std::ifstream file(path);
    if (!file)
        return {};
    const nlohmann::json json = nlohmann::json::parse(file);
    return TaskResult{ json.at("settings"),
                       json.at("target"),
                       { answers_of(json.at("up")), answers_of(json.at("colors")) } };
}

MeanWithInterval mean_of(const std::vector<TaskResult>& results, const std::vector<TaskResult>* base,
                         Answers TaskAnswers::*kind)
{
    MeanWithInterval result;
    std::vector<double> by_photo;
    for (std::size_t s = 0; s < results.size(); ++s) {
        const std::vector<double> of_seed =
            shares(results[s].answers.*kind, base ? &((*base)[s].answers.*kind) : nullptr);
        result.by_seed.push_back(mean(of_seed));
        by_photo.resize(of_seed.size());
        for (std::size_t i = 0; i < of_seed.size(); ++i)
            by_photo[i] += of_seed[i] / static_cast<double>(results.size());
    }
    result.mean = mean(result.by_seed);
    double squares = 0;
    for (const double value : result.by_seed)
        squares += (value - result.mean) * (value - result.mean);
    const std::size_t seeds = result.by_seed.size();
    result.seeds = seeds < 2 ? std::numeric_limits<double>::quiet_NaN()
                             : student(seeds - 1) * std::sqrt(squares / double(seeds - 1) / double(seeds));
    std::vector<double> means;
    srisp::train::Random random(1);
    for (int i = 0; i < kResamples; ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < by_photo.size(); ++k)
            sum += by_photo[random.integer(by_photo.size())];
        means.push_back(sum / static_cast<double>(by_photo.size()));
    }
    std::sort(means.begin(), means.end());
    result.photos_low = means[kResamples / 40];
    result.photos_high = means[kResamples - 1 - kResamples / 40];
    return result;
}

std::string report_text(const TaskResults& results, const std::string& base)
{
    std::string report = "targets:\n";
    for (const TaskResult& result : results.front().second)
        report += "  " + result.target + "\n";
    const std::vector<TaskResult>* of_base = find(results, base);
    for (const auto& [title, kind] : kKinds) {
        report +=
            std::string(title) + ": right answers in %, ± over seeds, [over photos]; difference to " + base + "\n";
        for (const auto& [name, of_method] : results) {
            char label[64];
            std::snprintf(label, sizeof label, "  %-18s", name.c_str());
            report += label + text(mean_of(of_method, nullptr, kind), false);
            if (of_base && name != base)
                report += "  " + text(mean_of(of_method, of_base, kind), true);
            report += "\n";
        }
    }
    return report;
}

nlohmann::ordered_json report_json(const TaskResults& results, const std::string& base)
{
    nlohmann::ordered_json report;
    for (const TaskResult& result : results.front().second)
        report["targets"].push_back(result.target);
    const std::vector<TaskResult>* of_base = find(results, base);
    for (const auto& [title, kind] : kKinds)
        for (const auto& [name, of_method] : results) {
            report[title][name]["right"] = json(mean_of(of_method, nullptr, kind));
            if (of_base && name != base)
                report[title][name]["difference"] = json(mean_of(of_method, of_base, kind));
        }
    return report;
}
