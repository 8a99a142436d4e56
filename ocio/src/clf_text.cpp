// SPDX-License-Identifier: Apache-2.0
#include "operators.h"

#include <algorithm>
#include <charconv>

#include "base/shown_text.h"

namespace srisp {

namespace {

const char kDepths[] = " inBitDepth=\"32f\" outBitDepth=\"32f\"";

/// The shortest text that reads back to the same bits; no locale.
template<class Number> void add_number(std::string& text, Number value)
{
    char digits[40];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

template<class Values> void add_rows(std::string& text, const Values& values, std::size_t columns)
{
    for (std::size_t i = 0; i < values.size(); ++i) {
        add_number(text, values[i]);
        text += i % columns == columns - 1 ? '\n' : ' ';
    }
    text += "        </Array>\n";
}

void add_element(std::string& text, const char* name, float value)
{
    text += std::string("        <") + name + ">";
    add_number(text, value);
    text += std::string("</") + name + ">\n";
}

void add_operator(std::string& text, const Clamp& clamp)
{
    text += std::string("    <Range") + kDepths + ">\n";
    add_element(text, "minInValue", clamp.low);
    add_element(text, "maxInValue", clamp.high);
    add_element(text, "minOutValue", clamp.low);
    add_element(text, "maxOutValue", clamp.high);
    text += "    </Range>\n";
}

void add_operator(std::string& text, const Limit& limit)
{
    text += std::string("    <Range") + kDepths + ">\n";
    add_element(text, "maxInValue", limit.high);
    add_element(text, "maxOutValue", limit.high);
    text += "    </Range>\n";
}

void add_operator(std::string& text, const Power& power)
{
    text += std::string("    <Exponent") + kDepths + " style=\"basicFwd\">\n        <ExponentParams exponent=\"";
    add_number(text, power.exponent);
    text += "\"/>\n    </Exponent>\n";
}

void add_operator(std::string& text, const Affine& affine)
{
    std::array<double, 12> rows;
    for (int row = 0; row < 3; ++row) {
        std::copy_n(&affine.matrix[row * 3], 3, &rows[row * 4]);
        rows[row * 4 + 3] = affine.offset[row];
    }
    text += std::string("    <Matrix") + kDepths + ">\n        <Array dim=\"3 4\">\n";
    add_rows(text, rows, 4);
    text += "    </Matrix>\n";
}

void add_operator(std::string& text, const Curves& curves)
{
    text += std::string("    <LUT1D") + kDepths + ">\n        <Array dim=\"" + std::to_string(curves.size) + " 3\">\n";
    add_rows(text, curves.rgb, 3);
    text += "    </LUT1D>\n";
}

void add_operator(std::string& text, const Cube& cube)
{
    const std::string size = std::to_string(cube.size) + " ";
    text += std::string("    <LUT3D") + kDepths + " interpolation=\"tetrahedral\">\n        <Array dim=\"" + size +
            size + size + "3\">\n";
    add_rows(text, cube.rgb, 3);
    text += "    </LUT3D>\n";
}

} // namespace

std::string clf_escaped(const std::string& text)
{
    std::string valid = valid_utf8(text), result;               // names of files may be any bytes
    for (const char* none : { "\xef\xbf\xbe", "\xef\xbf\xbf" }) // U+FFFE and U+FFFF
        for (std::size_t at; (at = valid.find(none)) != std::string::npos;)
            valid.replace(at, 3, "?");
    for (const char c : valid)
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
        }
    return result;
}

std::string clf_text(const Operators& operators, const ClfLabel& label)
{
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<ProcessList compCLFversion=\"3\" id=\"" +
                       clf_escaped(label.id) + "\" name=\"" + clf_escaped(label.name) + "\">\n";
    for (const std::string& description : label.descriptions)
        text += "    <Description>" + clf_escaped(description) + "</Description>\n";
    for (const Operator& op : operators)
        std::visit([&](const auto& each) { add_operator(text, each); }, op);
    return text + "</ProcessList>\n";
}

} // namespace srisp
