// SPDX-License-Identifier: Apache-2.0
#include "chart_parts.h"

#include <algorithm>
#include <cmath>

#include "html_text.h"

namespace srisp::tool {

namespace {

constexpr std::size_t kMethodClasses = 6;

std::string attribute(const char* name, double value)
{
    return std::string(" ") + name + "=\"" + coordinate(value) + "\"";
}

std::string css(const std::string& name)
{
    return name.empty() ? "" : " class=\"" + name + "\"";
}

} // namespace

std::vector<double> round_steps(double low, double high, int count)
{
    const double wanted = (high - low) / count;
    if (!(wanted > 0) || !std::isfinite(wanted))
        return {};
    double step = std::pow(10.0, std::floor(std::log10(wanted)));
    for (const double factor : { 1.0, 2.0, 5.0, 10.0 })
        if (step * factor >= wanted * 0.999) {
            step *= factor;
            break;
        }
    std::vector<double> steps;
    for (double i = std::ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i)
        steps.push_back(i * step);
    return steps;
}

int digits_of_steps(const std::vector<double>& steps)
{
    if (steps.size() < 2)
        return 2;
    return std::max(0, int(std::ceil(-std::log10(steps[1] - steps[0]) - 1e-9)));
}

std::pair<double, double> padded(double low, double high)
{
    const double air = high > low ? (high - low) * 0.05 : std::max(std::abs(low) * 0.1, 0.1);
    return { low - air, high + air };
}

std::string open_svg(int width, int height, const std::string& title, const std::string& description)
{
    return "<svg viewBox=\"0 0 " + std::to_string(width) + " " + std::to_string(height) +
           "\" role=\"img\" aria-label=\"" + title + ". " + description + "\"><title>" + title + "</title><desc>" +
           description + "</desc>\n";
}

std::string svg_line(double x1, double y1, double x2, double y2, const std::string& css_class)
{
    return "<line" + attribute("x1", x1) + attribute("y1", y1) + attribute("x2", x2) + attribute("y2", y2) +
           css(css_class) + "/>\n";
}

std::string svg_text(double x, double y, const std::string& text, const std::string& anchor,
                     const std::string& css_class)
{
    return "<text" + attribute("x", x) + attribute("y", y) + " text-anchor=\"" + anchor + "\"" + css(css_class) + ">" +
           text + "</text>\n";
}

std::string svg_path(const std::string& commands, const std::string& css_class)
{
    return commands.empty() ? "" : "<path d=\"" + commands + "\"" + css(css_class) + "/>\n";
}

std::string move_to(double x, double y)
{
    return "M" + coordinate(x) + " " + coordinate(y);
}

std::string line_to(double x, double y)
{
    return "L" + coordinate(x) + " " + coordinate(y);
}

std::string marker(std::size_t method, double x, double y)
{
    const std::string at = move_to(x, y);
    switch (method % kMethodClasses) {
    case 0: // circle
        return at + "m-3 0a3 3 0 1 0 6 0a3 3 0 1 0 -6 0z";
    case 1: // square
        return at + "m-2.8-2.8h5.6v5.6h-5.6z";
    case 2: // triangle
        return at + "m0-4l3.6 6.4h-7.2z";
    case 3: // diamond
        return at + "m0-4.2l4.2 4.2l-4.2 4.2l-4.2-4.2z";
    case 4: // cross, drawn as an area like the others
        return at +
               "m0-1.4l2.4-2.4l1.4 1.4l-2.4 2.4l2.4 2.4l-1.4 1.4l-2.4-2.4l-2.4 2.4l-1.4-1.4l2.4-2.4l-2.4-2.4l1.4-1.4z";
    default: // triangle on its tip
        return at + "m0 4l3.6-6.4h-7.2z";
    }
}

std::string method_class(std::size_t method)
{
    return "m" + std::to_string(method % kMethodClasses);
}

std::string bottom_axis(const Scale& x, const Scale& y, const std::string& label)
{
    std::string text = svg_line(x.begin, y.begin, x.end, y.begin, "axis");
    const std::vector<double> steps = round_steps(x.low, x.high, 6);
    for (const double step : steps) {
        text += svg_line(x(step), y.begin, x(step), y.end, step == 0 ? "grid zero" : "grid");
        text += svg_text(x(step), y.begin + 14, number(step, digits_of_steps(steps)));
    }
    return text + svg_text((x.begin + x.end) / 2, y.begin + 30, label, "middle", "label");
}

std::string left_axis(const Scale& x, const Scale& y, const std::string& label)
{
    std::string text;
    const std::vector<double> steps = round_steps(y.low, y.high, 5);
    for (const double step : steps) {
        text += svg_line(x.begin, y(step), x.end, y(step), step == 0 ? "grid zero" : "grid");
        text += svg_text(x.begin - 6, y(step) + 4, number(step, digits_of_steps(steps)), "end");
    }
    return text + svg_text(2, y.end - 8, label, "start", "label");
}

std::string legend(const std::vector<std::string>& names, const std::vector<std::size_t>& which)
{
    std::string text = "<ul class=\"legend\" aria-label=\"Legend\">";
    for (const std::size_t method : which)
        text += "<li><svg viewBox=\"0 0 30 12\" width=\"30\" height=\"12\" aria-hidden=\"true\" class=\"" +
                method_class(method) + "\">" + svg_line(1, 6, 29, 6, "series") +
                svg_path(marker(method, 15, 6), "mark") + "</svg>" + html(names[method]) + "</li>";
    return text + "</ul>\n";
}

std::string figure(const std::string& title, const std::string& chart, const std::string& how_to_read,
                   const std::string& css_class)
{
    return "<figure class=\"chart " + css_class + "\"><h4>" + title + "</h4>\n" + chart + "<figcaption>" + how_to_read +
           "</figcaption></figure>\n";
}

} // namespace srisp::tool
