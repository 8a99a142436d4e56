// SPDX-License-Identifier: Apache-2.0
#include "report_words.h"

#include <cmath>
#include <set>
#include <vector>

#include "html_text.h"

namespace srisp::tool {

namespace {

const Interval* find(const std::map<std::string, Interval>& values, const std::string& key)
{
    const auto found = values.find(key);
    return found != values.end() && std::isfinite(found->second.mean) ? &found->second : nullptr;
}

/// The measure that the answer is about: the first one for which methods differ.
const Metric* leading_metric(const MethodSummary& method)
{
    for (const char* key : { key::kPsnr, key::kLab, key::kRankGreen, key::kAngle })
        if (find(method.over_baseline, key))
            return &metric(key);
    return nullptr;
}

/// "default is +5.6 dB (95 % interval +5.1 to +6.2) over gain_match, at 0.42 of its angle".
std::string comparison(const MethodSummary& method, const MethodSummary& baseline)
{
    const Metric* leading = leading_metric(method);
    if (!leading)
        return "";
    const Interval& difference = method.over_baseline.at(leading->key);
    const std::string unit = *leading->unit ? " " + std::string(leading->unit) : "",
                      range = signed_range_text(difference, leading->digits),
                      what = signed_number(difference.mean, leading->digits) + unit +
                             (range.empty() ? "" : " (95 % interval " + range + ")"),
                      name = "<strong>" + html(method.method) + "</strong>", other = html(baseline.method);
    std::string text;
    if (is_within_noise(difference))
        text = name + " and " + other + " cannot be told apart by " + leading->title + ": " + what;
    else
        text = name + " is " + what + (difference.mean < 0 ? " against " : " over ") + other + " in " + leading->title;
    const Interval *angle = find(method.values, key::kAngle), *its = find(baseline.values, key::kAngle);
    if (angle && its && its->mean > 0)
        text += ", at " + number(angle->mean / its->mean, 2) + " of its colour angle";
    return text;
}

/// Each method against the baseline; where there is none but the baseline, what that reaches.
std::vector<std::string> findings(const GroupSummary& group)
{
    std::vector<std::string> found;
    for (std::size_t i = 1; i < group.methods.size(); ++i)
        if (const std::string one = comparison(group.methods[i], group.methods[0]); !one.empty())
            found.push_back(one);
    const Interval* psnr = group.methods.empty() ? nullptr : find(group.methods[0].values, key::kPsnr);
    if (found.empty() && psnr)
        found.push_back("<strong>" + html(group.methods[0].method) + "</strong> reaches " + number(psnr->mean, 2) +
                        " dB PSNR (95 % interval " + range_text(*psnr, 2) + ")");
    return found;
}

/// One finding is a sentence; several are a list.
std::string group_answer(const GroupSummary& group, bool named)
{
    const std::vector<std::string> found = findings(group);
    const std::string on = "on " + counted(group.images, "image") + " of " + counted(group.cameras, "camera"),
                      name = named ? "<em>" + rendering_title(group.rendering) + "</em>" : "";
    if (found.empty())
        return "";
    if (found.size() == 1)
        return "<p class=\"answer\">" + (named ? name + ": " : "") + found[0] + ", " + on + ".</p>\n";
    std::string text =
        "<p class=\"answer\">" + (named ? name + ", " + on : "On" + on.substr(2)) + ":</p>\n<ul class=\"answer\">\n";
    for (const std::string& one : found)
        text += "<li>" + one + "</li>\n";
    return text + "</ul>\n";
}

std::string pair_row(const std::string& name, const std::string& value)
{
    return "<tr><th scope=\"row\" class=\"name\">" + html(name) + "</th><td class=\"text\">" + html(value) +
           "</td></tr>\n";
}

/// How much there was.
std::string amount(const Evaluation& evaluation)
{
    std::set<std::string> files, cameras;
    for (const ImageScore& image : evaluation.images) {
        files.insert(image.image);
        cameras.insert(image.camera);
    }
    std::string text = counted(int(evaluation.images.size()), "test image") + " from " +
                       counted(int(files.size()), "file") + ", " + counted(int(cameras.size()), "camera") + ".";
    if (!evaluation.left_out.empty())
        text += " <a href=\"#left-out\">" + counted(int(evaluation.left_out.size()), "file") + " left out</a>.";
    return "<p>" + text + "</p>\n";
}

} // namespace

std::string report_title(const Evaluation& evaluation)
{
    return "Evaluation: " + html(evaluation.protocol);
}

std::string rendering_title(const std::string& rendering)
{
    return rendering == "photo" ? "photos as given" : html(rendering) + " rendering";
}

std::string answer_html(const Evaluation& evaluation)
{
    std::set<std::string> renderings;
    for (const GroupSummary& group : evaluation.groups)
        renderings.insert(group.rendering);
    std::string text;
    if (!evaluation.complete)
        text += "<p class=\"warning\" role=\"note\"><strong>Not complete.</strong> The evaluation was interrupted; the "
                "numbers are of the images that were done.</p>\n";
    for (const GroupSummary& group : evaluation.groups)
        if (group.camera.empty())
            text += group_answer(group, renderings.size() > 1);
    if (evaluation.images.empty())
        text += "<p class=\"warning\" role=\"note\"><strong>No image could be tested.</strong></p>\n";
    return text + amount(evaluation);
}

std::string protocol_html(const Evaluation& evaluation)
{
    std::string text;
    for (const std::string& paragraph : evaluation.protocol_text)
        text += "<p class=\"prose\">" + html(paragraph) + "</p>\n";
    text += "<div class=\"wide\"><table>\n<caption>Settings</caption>\n<tbody>\n";
    for (const auto& [name, value] : evaluation.settings)
        text += pair_row(name, value);
    text += pair_row("version of srisp", evaluation.version) + "</tbody>\n</table></div>\n";
    text += "<h3 id=\"left-out\">Left out</h3>\n";
    if (evaluation.left_out.empty())
        return text + "<p>No file was left out.</p>\n";
    text += "<div class=\"wide\"><table>\n<caption>Files that could not be tested</caption>\n<thead><tr>"
            "<th scope=\"col\">file</th><th scope=\"col\">reason</th></tr></thead>\n<tbody>\n";
    for (const LeftOut& one : evaluation.left_out)
        text += pair_row(one.file, one.reason);
    return text + "</tbody>\n</table></div>\n";
}

} // namespace srisp::tool
