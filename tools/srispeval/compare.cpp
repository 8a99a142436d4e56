// SPDX-License-Identifier: Apache-2.0
#include "compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>

#include <nlohmann/json.hpp>

#include "../common/failure.h"
#include "base/input_files.h"
#include "base/output_file.h"
#include "base/shown_text.h"
#include "bootstrap.h"
#include "metric_table.h"
#include "score_json.h"
#include "score_words.h"

namespace srisp::tool {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kSeed = 1;

/// The method of the first file, and that of the second.
using MethodPair = std::pair<std::string, std::string>;

/// One measure of one rendering.
struct Difference {
    std::string rendering;
    MethodPair methods;
    const Metric* metric;
    int images, files;
    double first, second;
    Interval difference; ///< second minus first
};

bool has(const Evaluation& evaluation, const std::string& method)
{
    return std::find(evaluation.methods.begin(), evaluation.methods.end(), method) != evaluation.methods.end();
}

/// As asked for; else all that both have; else the last of each.
std::vector<MethodPair> methods_to_compare(const Evaluation& a, const Evaluation& b, const EvalOptions& options)
{
    std::vector<MethodPair> pairs;
    for (const std::string& word : options.methods) {
        const std::size_t equals = word.find('=');
        const MethodPair pair{ word.substr(0, equals), equals == std::string::npos ? word : word.substr(equals + 1) };
        for (const auto& [file, name, evaluation] : { std::tuple(0, pair.first, &a), std::tuple(1, pair.second, &b) })
            if (!has(*evaluation, name))
                fail("'" + shown_text(options.inputs[std::size_t(file)]) + "' has no method '" + shown_text(name) +
                     "'");
        pairs.push_back(pair);
    }
    if (pairs.empty())
        for (const std::string& name : a.methods)
            if (has(b, name))
                pairs.emplace_back(name, name);
    if (pairs.empty() && !a.methods.empty() && !b.methods.empty())
        pairs.emplace_back(a.methods.back(), b.methods.back());
    return pairs;
}

/// Images that both files have, by rendering.
using Pairing = std::map<std::string, std::vector<std::pair<const ImageScore*, const ImageScore*>>>;

Pairing pair_images(const Evaluation& a, const Evaluation& b)
{
    const auto key = [](const ImageScore& image) {
        return std::tuple(image.image, image.part, image.rendering, image.reference);
    };
    std::map<decltype(key(a.images[0])), const ImageScore*> in_b;
    for (const ImageScore& image : b.images)
        in_b[key(image)] = &image;
    Pairing pairing;
    for (const ImageScore& image : a.images)
        if (const auto other = in_b.find(key(image)); other != in_b.end())
            pairing[image.rendering].emplace_back(&image, other->second);
    return pairing;
}

Measured value_of(const ImageScore& image, const std::string& method, const std::string& key)
{
    const auto score = image.methods.find(method);
    return score == image.methods.end() ? Measured{} : score->second.value(key);
}

std::vector<Difference> differences_of(const Pairing& pairing, const std::vector<MethodPair>& methods)
{
    std::vector<Difference> result;
    for (const auto& [rendering, images] : pairing) {
        std::map<std::string, std::size_t> files;
        for (const auto& [a, b] : images)
            files.emplace(a->image, files.size());
        const Bootstrap bootstrap(files.size(), kSeed);
        const FileCounts once(files.size(), 1);
        for (const MethodPair& pair : methods)
            for (const Metric& metric : metrics()) {
                PerFile of_first(files.size()), of_second(files.size());
                int compared = 0;
                for (const auto& [a, b] : images) {
                    const Measured first = value_of(*a, pair.first, metric.key),
                                   second = value_of(*b, pair.second, metric.key);
                    if (first.weight == 0 || second.weight == 0)
                        continue;
                    ++compared;
                    of_first[files[a->image]] += first;
                    of_second[files[a->image]] += second;
                }
                if (compared == 0)
                    continue;
                result.push_back({ rendering, pair, &metric, compared, int(files.size()), pooled(of_first, once),
                                   pooled(of_second, once), bootstrap.interval([&](const auto& counts) {
                                       return pooled(of_second, counts) - pooled(of_first, counts);
                                   }) });
            }
    }
    return result;
}

const char* verdict(const Difference& one)
{
    const Interval& d = one.difference;
    if (!std::isfinite(d.low))
        return "one file only: no interval";
    if (is_within_noise(d))
        return "within the noise";
    const double better = one.metric->better == Better::near_zero ? std::fabs(one.first) - std::fabs(one.second)
                          : one.metric->better == Better::lower   ? -d.mean
                                                                  : d.mean;
    return better > 0 ? "the second is better" : "the first is better";
}

void print_table(const std::vector<Difference>& differences)
{
    std::string title;
    int most = 0; // images under this title
    for (const Difference& one : differences) {
        std::string here = one.rendering + ": " + one.methods.first;
        if (one.methods.first != one.methods.second)
            here += " against " + one.methods.second;
        if (here != title) {
            std::printf("%s%s, %s of %s\n", title.empty() ? "" : "\n", shown_text(here, 400).c_str(),
                        counted(one.images, "image").c_str(), counted(one.files, "file").c_str());
            most = one.images;
        }
        title = here;
        const int digits = one.metric->digits;
        std::printf("  %s %9.*f %9.*f  %+.*f", padded_title(*one.metric).c_str(), digits, one.first, digits, one.second,
                    digits, one.difference.mean);
        if (std::isfinite(one.difference.low))
            std::printf(" (%.*f to %.*f)", digits, one.difference.low, digits, one.difference.high);
        std::printf("  %s", verdict(one));
        if (one.images != most)
            std::printf(" (%d images)", one.images);
        std::printf("\n");
    }
}

std::string json_of(const std::vector<Difference>& differences)
{
    Json list = Json::array();
    for (const Difference& one : differences)
        list.push_back({ { "rendering", one.rendering },
                         { "first", one.methods.first },
                         { "second", one.methods.second },
                         { "measure", one.metric->key },
                         { "images", one.images },
                         { "files", one.files },
                         { "first_mean", json_number(one.first) },
                         { "second_mean", json_number(one.second) },
                         { "difference", json_number(one.difference.mean) },
                         { "low", json_number(one.difference.low) },
                         { "high", json_number(one.difference.high) },
                         { "verdict", verdict(one) } });
    return Json{ { "format", "srisp-comparison-1" }, { "differences", list } }.dump(1, ' ', false,
                                                                                    Json::error_handler_t::replace) +
           "\n";
}

} // namespace

int compare_evaluations(const EvalOptions& options)
{
    InputFiles inputs;
    for (const std::string& path : options.inputs)
        inputs.add("input", path);
    if (!options.json.empty() && options.json != "-")
        require(inputs.check_output(options.json));
    const Evaluation a = require(read_evaluation(options.inputs[0])), b = require(read_evaluation(options.inputs[1]));
    const Pairing pairing = pair_images(a, b);
    const std::vector<Difference> differences = differences_of(pairing, methods_to_compare(a, b, options));
    if (differences.empty())
        fail("'" + shown_text(options.inputs[0]) + "' and '" + shown_text(options.inputs[1]) +
             "' have no image in common that both measured (same file, part, rendering and reference)");
    std::size_t common = 0;
    for (const auto& [rendering, images] : pairing)
        common += images.size();
    for (const auto& [path, count] :
         { std::pair(options.inputs[0], a.images.size()), std::pair(options.inputs[1], b.images.size()) })
        if (count > common)
            std::fprintf(stderr, "srispeval: %zu images are only in '%s'\n", count - common, shown_text(path).c_str());
    if (options.json != "-")
        print_table(differences);
    if (options.json == "-")
        std::fputs(json_of(differences).c_str(), stdout);
    else if (!options.json.empty())
        if (const Status written = write_output_file(options.json, json_of(differences)); !written)
            fail("output " + written.error().message);
    return 0;
}

} // namespace srisp::tool
