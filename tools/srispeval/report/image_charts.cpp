// SPDX-License-Identifier: Apache-2.0
#include "image_charts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "base/shown_text.h"
#include "chart_parts.h"
#include "html_text.h"

namespace srisp::tool {

namespace {

constexpr int kWidth = 460, kPanelHeight = 74, kLeft = 44, kRight = 12;
constexpr int kMostBins = 30;
constexpr std::size_t kMostPoints = 400; ///< images in a plot of colours
constexpr std::size_t kLongestName = 30;

std::string short_name(const std::string& name)
{
    const std::string_view begin = first_characters(name, kLongestName);
    return html(begin) + (begin.size() < name.size() ? "…" : "");
}

std::vector<double> values_of(const std::vector<const ImageScore*>& images, const std::string& method, const char* key)
{
    std::vector<double> values;
    for (const ImageScore* image : images) {
        const auto scores = image->methods.find(method);
        if (scores == image->methods.end())
            continue;
        const auto found = scores->second.values.find(key);
        if (found != scores->second.values.end() && std::isfinite(found->second.value()))
            values.push_back(found->second.value());
    }
    std::sort(values.begin(), values.end());
    return values;
}

double median(const std::vector<double>& sorted)
{
    return (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]) / 2;
}

/// Equal bins with round edges.
struct Bins {
    double low = 0, step = 1;
    int count = 1;

    std::vector<int> counts(const std::vector<double>& values) const
    {
        std::vector<int> all(std::size_t(count), 0);
        for (const double value : values)
            ++all[std::size_t(std::clamp(int((value - low) / step), 0, count - 1))];
        return all;
    }
};

Bins bins_over(double low, double high)
{
    const auto [least, most] = high > low ? std::pair(low, high) : padded(low, high);
    const std::vector<double> edges = round_steps(least, most, kMostBins);
    if (edges.size() < 2)
        return { least, most - least, 1 };
    const double step = edges[1] - edges[0], first = std::floor(least / step + 1e-9) * step;
    return { first, step, std::max(1, int(std::ceil((most - first) / step + 1e-9))) };
}

std::string bars(const Bins& bins, const std::vector<int>& counts, const Scale& x, const Scale& y)
{
    std::string commands;
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] > 0) {
            const double begin = bins.low + bins.step * double(i);
            commands += move_to(x(begin) + 0.5, y.begin) + "V" + coordinate(y(counts[i])) + "H" +
                        coordinate(x(begin + bins.step) - 0.5) + "V" + coordinate(y.begin) + "z";
        }
    return svg_path(commands, "mark");
}

/// The colours of one image that a panel of one method shows.
struct Colors {
    std::optional<Chromaticity> reference, truth, result;
};

std::vector<Colors> colors_of(const std::vector<const ImageScore*>& images, const std::string& method)
{
    std::vector<Colors> colors;
    const std::size_t stride = (images.size() + kMostPoints - 1) / kMostPoints;
    for (std::size_t i = 0; i < images.size(); i += stride) {
        const auto scores = images[i]->methods.find(method);
        if (scores != images[i]->methods.end() && scores->second.chromaticity)
            colors.push_back(
                { images[i]->reference_chromaticity, images[i]->truth_chromaticity, scores->second.chromaticity });
    }
    return colors;
}

/// A square range for both axes that holds all colours, so that a distance is the same in every direction.
struct Square {
    double low[2] = { std::numeric_limits<double>::max(), std::numeric_limits<double>::max() };
    double high[2] = { std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest() };

    void add(const std::optional<Chromaticity>& color)
    {
        for (int i = 0; color && i < 2; ++i) {
            low[i] = std::min(low[i], (*color)[std::size_t(i)]);
            high[i] = std::max(high[i], (*color)[std::size_t(i)]);
        }
    }
    void make_square()
    {
        const double side = std::max({ high[0] - low[0], high[1] - low[1], 0.1 }) * 1.1;
        for (int i = 0; i < 2; ++i) {
            const double middle = (low[i] + high[i]) / 2;
            low[i] = middle - side / 2;
            high[i] = middle + side / 2;
        }
    }
};

std::string color_panel(const std::vector<Colors>& colors, const Square& range, std::size_t method,
                        const std::string& name)
{
    constexpr int kSide = 240, kBottom = 40, kTop = 40;
    const Scale x{ range.low[0], range.high[0], kLeft, kLeft + kSide };
    const Scale y{ range.low[1], range.high[1], kTop + kSide, kTop };
    std::string references, truths, errors, results;
    for (const Colors& one : colors) {
        const auto& result = *one.result;
        if (one.reference)
            references += move_to(x((*one.reference)[0]), y((*one.reference)[1])) + "h0";
        if (one.truth) {
            const double at_x = x((*one.truth)[0]), at_y = y((*one.truth)[1]);
            truths += move_to(at_x, at_y) + "m-3.2 0a3.2 3.2 0 1 0 6.4 0a3.2 3.2 0 1 0 -6.4 0z";
            errors += move_to(at_x, at_y) + line_to(x(result[0]), y(result[1]));
        }
        results += marker(method, x(result[0]), y(result[1]));
    }
    return open_svg(kLeft + kSide + kRight, kTop + kSide + kBottom, "Mean colours of " + name,
                    std::to_string(colors.size()) +
                        " images; ln of red over green to the right, of blue over green up") +
           svg_text(kLeft, 14, name, "start", "panel") + bottom_axis(x, y, "ln R/G") + left_axis(x, y, "ln B/G") +
           svg_path(references, "references") + svg_path(errors, "errors") + svg_path(truths, "truths") +
           "<g class=\"" + method_class(method) + "\">" + svg_path(results, "mark results") + "</g>" + kEndOfSvg;
}

} // namespace

std::string histogram(const std::vector<const ImageScore*>& images, const std::vector<std::string>& methods,
                      const Metric& metric)
{
    std::vector<std::vector<double>> values;
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (const std::string& method : methods) {
        values.push_back(values_of(images, method, metric.key));
        if (!values.back().empty()) {
            low = std::min(low, values.back().front());
            high = std::max(high, values.back().back());
        }
    }
    if (low > high)
        return "";
    const Bins bins = bins_over(low, high);
    int most = 1;
    for (const auto& some : values)
        for (const int count : bins.counts(some))
            most = std::max(most, count);
    const int height = kPanelHeight * int(methods.size()) + 40;
    const Scale x{ bins.low, bins.low + bins.step * bins.count, kLeft, kWidth - kRight };
    const Scale whole{ 0, 1, double(height - 40), 4 };
    std::string chart = bottom_axis(x, whole, html(title_with_unit(metric))), description = "Medians:";
    for (std::size_t i = 0; i < methods.size(); ++i) {
        const double bottom = kPanelHeight * double(i + 1);
        const Scale y{ 0, double(most), bottom, bottom - kPanelHeight + 24 };
        chart += "<g class=\"" + method_class(i) + "\">" + bars(bins, bins.counts(values[i]), x, y);
        chart += svg_line(x.begin, bottom, x.end, bottom, "axis");
        chart +=
            svg_text(x.begin - 6, bottom, "0", "end") + svg_text(x.begin - 6, y.end + 8, std::to_string(most), "end");
        std::string label = "none";
        if (!values[i].empty()) {
            const double middle = median(values[i]);
            label = number(middle, metric.digits);
            chart += svg_line(x(middle), bottom, x(middle), bottom - kPanelHeight + 20, "median");
        }
        chart += svg_text(x.begin, bottom - kPanelHeight + 14, short_name(methods[i]), "start", "panel");
        chart += svg_text(x.end, bottom - kPanelHeight + 14, "median " + label, "end") + "</g>";
        description += " " + short_name(methods[i]) + " " + label + (i + 1 < methods.size() ? "," : ".");
    }
    const std::string title = html(metric.title) + " of single images";
    return figure(title, open_svg(kWidth, height, title, description) + chart + kEndOfSvg,
                  std::string("A bar's height is the number of images with that ") + html(metric.title) + "; the " +
                      (metric.better == Better::higher ? "further to the right" : "further to the left") +
                      " a method's bars lie, the better; the dashed line is its median.");
}

std::string chromaticity_plot(const std::vector<const ImageScore*>& images, const std::vector<std::string>& methods)
{
    std::vector<std::vector<Colors>> colors;
    Square range;
    std::size_t count = 0;
    for (const std::string& method : methods) {
        colors.push_back(colors_of(images, method));
        count += colors.back().size();
        for (const Colors& one : colors.back())
            for (const auto& color : { one.reference, one.truth, one.result })
                range.add(color);
    }
    if (count == 0)
        return "";
    range.make_square();
    std::string panels = "<div class=\"panels\">\n";
    for (std::size_t i = 0; i < methods.size(); ++i)
        if (!colors[i].empty())
            panels += color_panel(colors[i], range, i, short_name(methods[i]));
    const std::string sample = images.size() > kMostPoints ? " Of many images, evenly chosen ones are drawn." : "";
    const bool has_truth = std::any_of(images.begin(), images.end(),
                                       [](const ImageScore* image) { return image->truth_chromaticity.has_value(); });
    const std::string how_to_read =
        has_truth
            ? "A filled mark is a result's mean colour, the ring at the other end of its line the truth's, a small "
              "dot a reference's: short lines are good, and results that gather at the dots copy their reference."
            : "A filled mark is a result's mean colour, a small dot a reference's: results should lie where "
              "references lie, as far spread.";
    return figure("Mean colour of images", panels + "</div>\n", how_to_read + sample, "full");
}

} // namespace srisp::tool
