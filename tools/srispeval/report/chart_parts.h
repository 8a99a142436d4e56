// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

// Pieces of charts in SVG. Colours, lines and sizes of text are in report.css; classes m0, m1, … are methods.

namespace srisp::tool {

/// From values to pixels.
struct Scale {
    double low, high;  ///< values
    double begin, end; ///< where they lie

    double operator()(double value) const { return begin + (value - low) / (high - low) * (end - begin); }
};

/// Round numbers (1, 2 or 5 times a power of ten apart) within a range, about `count` of them.
std::vector<double> round_steps(double low, double high, int count);
/// Digits behind the point that tell such numbers apart.
int digits_of_steps(const std::vector<double>& steps);
/// A range with some air, also where all values are one.
std::pair<double, double> padded(double low, double high);

/// An <svg> as one image with a name and a description, which are HTML already.
std::string open_svg(int width, int height, const std::string& title, const std::string& description);
constexpr char kEndOfSvg[] = "</svg>\n";

std::string svg_line(double x1, double y1, double x2, double y2, const std::string& css_class);
/// `anchor`: "start", "middle", "end".
std::string svg_text(double x, double y, const std::string& text, const std::string& anchor = "middle",
                     const std::string& css_class = "");
std::string svg_path(const std::string& commands, const std::string& css_class);
std::string move_to(double x, double y);
std::string line_to(double x, double y);

/// The shape that stands for a method, as commands of a path: methods differ by more than colour.
std::string marker(std::size_t method, double x, double y);

/// Class of a method's marks: "m0" … "m5".
std::string method_class(std::size_t method);

/// An axis at the bottom or at the left with round numbers and lines across the plot.
std::string bottom_axis(const Scale& x, const Scale& y, const std::string& label);
std::string left_axis(const Scale& x, const Scale& y, const std::string& label);

/// Which mark is which method's. `which`: indices into names.
std::string legend(const std::vector<std::string>& names, const std::vector<std::size_t>& which);

/// A chart with the sentence that tells how to read it, as HTML.
std::string figure(const std::string& title, const std::string& chart, const std::string& how_to_read,
                   const std::string& css_class = "");

} // namespace srisp::tool
