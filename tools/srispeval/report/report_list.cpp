// SPDX-License-Identifier: Apache-2.0
#include "report_list.h"

#include <cmath>

#include "html_text.h"

namespace srisp::tool {

namespace {

constexpr std::size_t kMostMetrics = 3; ///< that a table as wide as the page has room for

double value_of(const ImageScore& image, const std::string& method, const std::string& key)
{
    const auto scores = image.methods.find(method);
    if (scores == image.methods.end())
        return NAN;
    const auto found = scores->second.values.find(key);
    return found != scores->second.values.end() ? found->second.value() : NAN;
}

/// The leading measures, where any image has them.
std::vector<const Metric*> leading_metrics(const Evaluation& evaluation)
{
    std::vector<const Metric*> found;
    const auto has = [&](const char* key) {
        for (const ImageScore& image : evaluation.images)
            for (const std::string& method : evaluation.methods)
                if (std::isfinite(value_of(image, method, key)))
                    return true;
        return false;
    };
    for (const char* key : { key::kPsnr, key::kAngle, key::kBrightness, key::kLab, key::kRankGreen, key::kRankRed })
        if (found.size() < kMostMetrics && has(key))
            found.push_back(&metric(key));
    return found;
}

/// The script turns what a head holds into a button that sorts.
std::string sorting_head(const std::string& title, bool is_number, const std::string& more = "")
{
    return "<th scope=\"col\"" + std::string(is_number ? " class=\"n\"" : "") + more + "><span>" + title +
           "</span></th>";
}

std::string head(const Evaluation& evaluation, const std::vector<const Metric*>& metrics)
{
    const std::string methods = std::to_string(evaluation.methods.size());
    std::string text = "<thead>\n<tr><td colspan=\"5\"></td>", second;
    for (const char* title : { "image", "part", "rendering", "camera" })
        second += sorting_head(title, false);
    for (const Metric* one : metrics) {
        text += "<th scope=\"colgroup\" colspan=\"" + methods + "\" title=\"" + html(one->text) + "\">" +
                html(title_with_unit(*one)) + "</th>";
        for (const std::string& method : evaluation.methods)
            second += sorting_head("<span class=\"hidden\">" + html(one->title) + ", </span>" + html(method), true,
                                   &method == &evaluation.methods[0] ? " data-first" : "");
    }
    return text + "</tr>\n<tr>" + sorting_head("rank", true, " aria-sort=\"ascending\"") + second + "</tr>\n</thead>\n";
}

std::string row(const Evaluation& evaluation, const std::vector<const Metric*>& metrics, std::size_t index,
                std::size_t rank, bool is_shown)
{
    const ImageScore& image = evaluation.images[index];
    const std::string name = html(image.image);
    std::string text = "<tr><td class=\"n\">" + std::to_string(rank) + "</td><th scope=\"row\" class=\"name\">";
    text += is_shown ? "<a href=\"#" + picture_anchor(index) + "\">" + name + "</a>" : name;
    text += "</th><td>" + html(image.part) + "</td><td>" + html(image.rendering) + "</td><td>" + html(image.camera) +
            "</td>";
    for (const Metric* one : metrics)
        for (const std::string& method : evaluation.methods)
            text += "<td class=\"n\">" + number(value_of(image, method, one->key), one->digits) + "</td>";
    return text + "</tr>\n";
}

} // namespace

std::string picture_anchor(std::size_t image)
{
    return "picture-" + std::to_string(image);
}

std::string image_title(const ImageScore& image)
{
    return html(image.image) + (image.part.empty() ? "" : ", " + html(image.part));
}

std::string image_table_html(const Evaluation& evaluation, const std::vector<std::size_t>& shown)
{
    const std::vector<const Metric*> metrics = leading_metrics(evaluation);
    std::string text =
        "<div class=\"wide tall\" role=\"region\" tabindex=\"0\" aria-label=\"All images\"><table class=\"sortable\">\n"
        "<caption>All images, the worst first. A linked name leads to its pictures.</caption>\n";
    text += head(evaluation, metrics) + "<tbody>\n";
    std::vector<bool> is_shown(evaluation.images.size());
    std::size_t rank = 0;
    for (const std::size_t index : shown) {
        is_shown[index] = true;
        text += row(evaluation, metrics, index, ++rank, true);
    }
    for (std::size_t index = 0; index < is_shown.size(); ++index)
        if (!is_shown[index])
            text += row(evaluation, metrics, index, ++rank, false);
    return text + "</tbody>\n</table></div>\n";
}

} // namespace srisp::tool
