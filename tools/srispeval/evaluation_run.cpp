// SPDX-License-Identifier: Apache-2.0
#include "evaluation_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <tuple>

#include <nlohmann/json.hpp>
#include <srisp/metrics.h>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "base/hashes.h"
#include "base/input_files.h"
#include "base/output_file.h"
#include "journal.h"
#include "metric_table.h"
#include "score_csv.h"
#include "score_json.h"
#include "score_table.h"
#include "shown_images.h"
#include "summary.h"
#include "task_runner.h"

namespace srisp::tool {

namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

/// What the results depend on beside the files, as the report tells it.
Settings settings_of(const EvalOptions& options, const Methods& methods)
{
    Settings settings;
    for (const auto& method : methods)
        settings.emplace_back("method " + method->name, method->origin);
    settings.emplace_back("size", options.size ? "longer side at most " + std::to_string(options.size) +
                                                     " pixels, by averaging areas"
                                               : "full");
    settings.emplace_back("seed", std::to_string(options.seed));
    if (options.job == EvalOptions::Job::unpaired)
        settings.emplace_back("references of each photo", std::to_string(options.reference_count));
    else
        settings.emplace_back("edits", std::to_string(options.edits));
    if (options.job == EvalOptions::Job::half_split) {
        std::string names;
        for (const std::string& name : options.renderings)
            names += (names.empty() ? "" : ", ") + name;
        settings.emplace_back("renderings", names);
    }
    return settings;
}

/// Where the report's numbers come from, for readers.
std::vector<std::string> measures_text()
{
    return {
        "PSNR, SSIM and angle are those of linear values, clamped to 0 … 1, peak 1; pixels without a colour (a norm "
        "below 1e-6) are left out of the angle. Lab and ΔE2000 use the inverse of the camera's XYZ matrix for "
        "daylight. PSNR ends at 100 dB.",
        "Intervals hold 95 %: the bootstrap's 2.5th and 97.5th percentile over 1000 draws of files, not of images, "
        "since what several images of one file show is no independent evidence. Differences to the first method "
        "are drawn together with it.",
        "PSNRs that other programs publish cannot be compared with these: how a test renders its photos decides the "
        "score."
    };
}

/// The paper's histogram intersection, over all images of each rendering together.
void add_pooled_lab(const Journal& journal, const std::vector<const Journal::Entry*>& entries,
                    std::vector<GroupSummary>& groups)
{
    std::map<std::pair<std::string, std::string>, std::pair<LabHistogram, LabHistogram>> histograms;
    for (const Journal::Entry* entry : entries)
        for (const auto& [method, counts] : journal.lab(*entry)) {
            auto& [result, wanted] = histograms[{ entry->score.rendering, method }];
            result.add_counts(counts.result);
            wanted.add_counts(counts.wanted);
        }
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    for (GroupSummary& group : groups)
        for (MethodSummary& method : group.methods) {
            const auto found = histograms.find({ group.rendering, method.method });
            if (group.camera.empty() && found != histograms.end())
                method.values[key::kLabPooled] = { found->second.first.intersection(found->second.second), kNone,
                                                   kNone };
        }
}

/// The journal's images in the order of the tasks.
std::vector<const Journal::Entry*> entries_in_order(const Journal& journal, const Protocol& protocol)
{
    std::map<std::string, std::vector<const Journal::Entry*>> by_task;
    for (const Journal::Entry& entry : journal.entries())
        by_task[entry.task].push_back(&entry);
    std::vector<const Journal::Entry*> result;
    for (const EvalTask& task : protocol.tasks)
        if (const auto found = by_task.find(key_of(task)); found != by_task.end())
            result.insert(result.end(), found->second.begin(), found->second.end());
    return result;
}

/// Files and parts of files that were not tested, sorted.
std::vector<LeftOut> all_left_out(const Protocol& protocol, const Journal& journal, const std::vector<LeftOut>& failed)
{
    std::vector<LeftOut> result = protocol.left_out;
    result.insert(result.end(), failed.begin(), failed.end());
    for (const EvalTask& task : protocol.tasks)
        if (const auto found = journal.left_out().find(key_of(task)); found != journal.left_out().end())
            result.insert(result.end(), found->second.begin(), found->second.end());
    std::sort(result.begin(), result.end(), [](const LeftOut& a, const LeftOut& b) {
        return std::tie(a.file, a.reason) < std::tie(b.file, b.reason);
    });
    return result;
}

/// Most reasons name the file by its path.
std::string text_of(const LeftOut& one)
{
    return one.reason.find(one.file) == std::string::npos ? one.file + ": " + one.reason : one.reason;
}

void write_text(const std::string& path, const std::string& text)
{
    if (path == "-")
        std::fputs(text.c_str(), stdout);
    else if (!path.empty())
        if (const Status written = write_output_file(path, text); !written)
            fail("output " + written.error().message);
}

void write_html(const EvalOptions& options, const Evaluation& evaluation, const Journal& journal,
                const std::vector<const Journal::Entry*>& entries)
{
    OutputFile file(options.report);
    const Status made = write_report(
        evaluation, shown_images(evaluation, std::size_t(options.pictures)),
        [&](std::size_t i) -> Expected<ImagePictures> { return journal.pictures(*entries[i]); }, file);
    if (file.good()) // else the file says why
        require(made);
    if (const Status written = file.finish(); !written)
        fail("report " + written.error().message);
}

/// Beside the first output that is a file; empty: there is none.
std::string journal_path(const EvalOptions& options)
{
    for (const std::string& path : { options.report, options.json, options.csv }) {
        std::error_code error;
        const bool is_device = std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error);
        if (!path.empty() && path != "-" && !is_device)
            return path + ".unfinished";
    }
    return "";
}

/// No output may take the place of an input.
void check_outputs(const EvalOptions& options, const Protocol& protocol)
{
    InputFiles inputs;
    for (const std::vector<std::string>& paths : { options.inputs, options.references })
        for (const std::string& path : paths)
            inputs.add("input", path);
    for (const EvalTask& task : protocol.tasks)
        for (const std::string& path : task.files)
            inputs.add("input", path);
    for (const std::string& path : options.models)
        inputs.add("model", path);
    for (const std::string& path : { options.report, options.json, options.csv }) {
        if (path.empty() || path == "-")
            continue;
        require(inputs.check_output(path));
        const std::filesystem::path folder = std::filesystem::path(path).parent_path();
        std::error_code error;
        if (!folder.empty() && !std::filesystem::is_directory(folder, error))
            fail("output '" + path + "' cannot be created: there is no folder '" + folder.string() + "'");
    }
}

} // namespace

int run_evaluation(const EvalOptions& options, const Protocol& protocol)
{
    check_outputs(options, protocol);
    const Methods methods = load_methods(options.baselines, options.models, options.seed);
    Evaluation evaluation;
    evaluation.settings = settings_of(options, methods);
    const std::size_t images = protocol.tasks.size() * std::size_t(protocol.images_per_task);
    const int picture_size =
        options.report.empty()
            ? 0
            : picture_side(images, std::min(images, std::size_t(options.pictures)), methods.size(), options.report_mb);
    std::string settings = std::string(SRISP_VERSION) + " " + protocol.name + " " + std::to_string(picture_size);
    for (const auto& [name, value] : evaluation.settings)
        settings += "\n" + name + ": " + value;
    Journal journal(journal_path(options), hash_of_bytes(settings.data(), settings.size()));

    const std::vector<LeftOut> failed = run_tasks(options, protocol, methods, picture_size, journal);
    evaluation.left_out = all_left_out(protocol, journal, failed);
    const auto entries = entries_in_order(journal, protocol);
    evaluation.protocol = protocol.name;
    evaluation.protocol_text = protocol.text;
    for (const std::string& text : measures_text())
        evaluation.protocol_text.push_back(text);
    evaluation.version = SRISP_VERSION;
    evaluation.has_truth = protocol.has_truth;
    evaluation.complete = !pending_interrupt();
    for (const auto& method : methods)
        evaluation.methods.push_back(method->name);
    for (const Journal::Entry* entry : entries)
        evaluation.images.push_back(entry->score);
    for (const LeftOut& one : evaluation.left_out)
        std::fprintf(stderr, "srispeval: left out: %s\n", text_of(one).c_str());
    if (entries.empty()) {
        check_interrupt();
        fail("nothing could be tested");
    }
    std::set<std::string> cameras;
    for (const ImageScore& image : evaluation.images)
        cameras.insert(image.camera);
    evaluation.groups = summarize(evaluation.images, evaluation.methods, cameras_seen(methods, cameras));
    add_pooled_lab(journal, entries, evaluation.groups);

    write_text(options.json, options.json.empty() ? "" : to_json(evaluation));
    write_text(options.csv, options.csv.empty() ? "" : to_csv(evaluation));
    if (!options.report.empty())
        write_html(options, evaluation, journal, entries);
    if (options.json != "-")
        std::fputs(score_table(evaluation, options.by_camera).c_str(), stdout);
    if (!evaluation.complete) {
        std::fprintf(stderr, "srispeval: stopped; this is of what was done, and the same command goes on from there\n");
        check_interrupt();
    }
    journal.remove();
    return evaluation.left_out.empty() ? 0 : kExitFailed;
}

} // namespace srisp::tool
