// SPDX-License-Identifier: Apache-2.0
#include "report_charts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "chart_parts.h"
#include "html_text.h"
#include "image_charts.h"
#include "report_words.h"

namespace srisp::tool {

namespace {

constexpr int kWidth = 460, kHeight = 300, kLeft = 52, kRight = 12, kTop = 24, kBottom = 44;

/// A chart of all methods in one plot.
struct Plot {
    std::vector<std::string> names;
    std::vector<std::size_t> which; ///< that have something to show
};

std::string line_and_marks(std::size_t method, const std::vector<std::pair<double, double>>& points,
                           const std::string& whiskers)
{
    std::string line, marks;
    for (const auto& [x, y] : points) {
        line += line.empty() ? move_to(x, y) : line_to(x, y);
        marks += marker(method, x, y);
    }
    return "<g class=\"" + method_class(method) + "\">" + svg_path(whiskers, "whisker") + svg_path(line, "series") +
           svg_path(marks, "mark") + "</g>";
}

/// The bins' edges below the axis: 0, 1/256, …, 1/2, 1.
std::string level_axis(const Scale& x, const Scale& y)
{
    std::string text = svg_line(x.begin, y.begin, x.end, y.begin, "axis");
    for (int edge = 0; edge <= kLevels; ++edge) {
        const std::string name = edge == 0 ? "0" : edge == kLevels ? "1" : "1/" + std::to_string(1 << (kLevels - edge));
        text += svg_line(x(edge), y.begin, x(edge), y.begin + 4, "axis") + svg_text(x(edge), y.begin + 16, name);
    }
    return text + svg_text((x.begin + x.end) / 2, y.begin + 32, "value of the truth, doubling from step to step",
                           "middle", "label");
}

std::string error_by_level(const GroupSummary& group)
{
    double low = 0, high = 0;
    Plot plot;
    for (const MethodSummary& method : group.methods) {
        bool has = false;
        for (const Interval& error : method.error_by_level)
            for (const double value : { error.low, error.mean, error.high })
                if (std::isfinite(value)) {
                    low = std::min(low, value);
                    high = std::max(high, value);
                    has = true;
                }
        if (has)
            plot.which.push_back(plot.names.size());
        plot.names.push_back(method.method);
    }
    if (plot.which.empty())
        return "";
    const auto [least, most] = padded(low, high);
    const Scale x{ 0, kLevels, kLeft, kWidth - kRight }, y{ least, most, kHeight - kBottom, kTop };
    std::string chart = left_axis(x, y, "result − truth") + level_axis(x, y);
    for (std::size_t i = 0; i < plot.which.size(); ++i) {
        const MethodSummary& method = group.methods[plot.which[i]];
        // Side by side within a bin, so that intervals do not cover each other.
        const double shift = (double(i) + 1) / (double(plot.which.size()) + 1);
        std::vector<std::pair<double, double>> points;
        std::string whiskers;
        for (int level = 0; level < kLevels; ++level) {
            const Interval& error = method.error_by_level[std::size_t(level)];
            if (!std::isfinite(error.mean))
                continue;
            points.emplace_back(x(level + shift), y(error.mean));
            if (std::isfinite(error.low) && std::isfinite(error.high))
                whiskers += move_to(x(level + shift), y(error.low)) + line_to(x(level + shift), y(error.high));
        }
        chart += line_and_marks(plot.which[i], points, whiskers);
    }
    const std::string title = "Error by brightness";
    return figure(
        title,
        legend(plot.names, plot.which) +
            open_svg(kWidth, kHeight, title, "Mean error of single values, by the truth's value") + chart + kEndOfSvg,
        "Shadows are at the left, highlights at the right; above the zero line results are too bright, below it "
        "too dark, by that part of full scale; bars are 95 % intervals.");
}

std::string calibration(const GroupSummary& group)
{
    Plot plot;
    for (const MethodSummary& method : group.methods) {
        if (method.coverage.size() == kCoverage.size())
            plot.which.push_back(plot.names.size());
        plot.names.push_back(method.method);
    }
    if (plot.which.empty())
        return "";
    const Scale x{ 0, kCoverage.back(), kLeft, kWidth - kRight }, y{ 0, 1, kHeight - kBottom, kTop };
    std::string chart = left_axis(x, y, "share of images") + bottom_axis(x, y, "error, in the deviations told"), normal;
    for (double z = 0; z <= kCoverage.back() + 1e-9; z += 0.125)
        normal += (normal.empty() ? move_to : line_to)(x(z), y(std::erf(z / std::sqrt(2.0))));
    chart += svg_path(normal, "normal");
    chart += svg_text(x(2.1), y(0.88), "normal distribution", "start", "label");
    for (const std::size_t i : plot.which) {
        std::vector<std::pair<double, double>> points;
        for (std::size_t k = 0; k < kCoverage.size(); ++k)
            if (std::isfinite(group.methods[i].coverage[k]))
                points.emplace_back(x(kCoverage[k]), y(group.methods[i].coverage[k]));
        chart += line_and_marks(i, points, "");
    }
    const std::string title = "How well results know their error";
    return figure(title,
                  legend(plot.names, plot.which) +
                      open_svg(kWidth, kHeight, title, "Share of brightness errors within so many deviations told") +
                      chart + kEndOfSvg,
                  "On the dotted curve the deviations told are right; below it errors are larger than told, above it "
                  "smaller.");
}

} // namespace

std::string charts_html(const Evaluation& evaluation)
{
    std::string text;
    for (const GroupSummary& group : evaluation.groups) {
        if (!group.camera.empty())
            continue;
        std::vector<const ImageScore*> images;
        for (const ImageScore& image : evaluation.images)
            if (image.rendering == group.rendering)
                images.push_back(&image);
        std::string charts;
        for (const char* key : { key::kPsnr, key::kAngle, key::kLab })
            if (key != std::string(key::kLab) || !evaluation.has_truth)
                charts += histogram(images, evaluation.methods, metric(key));
        charts += error_by_level(group) + calibration(group) + chromaticity_plot(images, evaluation.methods);
        if (!charts.empty())
            text += "<section class=\"rendering\">\n<h3>" + rendering_title(group.rendering) +
                    "</h3>\n<div class=\"charts\">\n" + charts + "</div>\n</section>\n";
    }
    return text;
}

} // namespace srisp::tool
