// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <cmath>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <srisp/model.h>
#include <srisp/parameters.h>
#include <srisp/select.h>

#include "arrays.h"
#include "bindings.h"

namespace srisp::python {

namespace {

/// Read-only, so that editing a copy in vain is an error.
py::array color_of(const Parameters& parameters)
{
    py::array_t<float> matrix({ 3, 3 }, parameters.color.data());
    matrix.attr("flags").attr("writeable") = false;
    return std::move(matrix);
}

void set_color(Parameters& parameters, const std::array<std::array<float, 3>, 3>& rows)
{
    parameters.color = row_major(rows);
}

/// A list as a tuple, likewise.
template<class Values> auto tuple_getter(Values Parameters::*member)
{
    return [member](const Parameters& parameters) { return py::tuple(py::cast(parameters.*member)); };
}
template<class Values> auto setter(Values Parameters::*member)
{
    return [member](Parameters& parameters, const Values& values) { parameters.*member = values; };
}

py::object json_module()
{
    return py::module_::import("json");
}

std::string number(double value)
{
    char text[32]; // a point before the fraction, whatever the locale
    return { text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4).ptr };
}

template<class Values> std::string numbers(const Values& values)
{
    std::string text;
    for (const float value : values)
        text += (text.empty() ? "" : ", ") + number(value);
    return "(" + text + ")";
}

std::string shown(const Parameters& parameters)
{
    std::string text = "Parameters(gamma=" + number(parameters.gamma) + ", color=" + numbers(parameters.color) +
                       ", white_balance=" + numbers(parameters.white_balance) + ", gain=" + number(parameters.gain);
    if (parameters.brightness_sd_ev)
        text += ", brightness_sd_ev=" + number(*parameters.brightness_sd_ev);
    if (parameters.brightness_ev != 0)
        text += ", brightness_ev=" + number(parameters.brightness_ev);
    text += ", model_name=" + quoted(parameters.model_name);
    if (!parameters.reference_name.empty())
        text += ", reference_name=" + quoted(parameters.reference_name);
    return text + ")";
}

Parameters from_text(const std::string& text, const std::string& where)
{
    return value_of(parameters_from_json(text, where));
}

} // namespace

void bind_parameters(py::module_& module)
{
    using P = Parameters;
    py::class_<P>(module, "Parameters",
                  R"(What was chosen for one photo and one reference: a plain value of a few hundred bytes.

It can be printed, edited, saved as JSON, pickled and applied to other photos. `gain`, `white_balance`, `color` and `gamma`
win as they stand; their weights are a record only. The tone curve is mixed from the model by `tone_weights`.)")
        .def(py::init<>(), "Parameters that change nothing but by the tone curve, which has no weights yet.")
        .def_readwrite("gamma", &P::gamma, "Exponent of the reverse pass, > 0.")
        .def_property("color", &color_of, &set_color,
                      "3 x 3 array: camera RGB to linear sRGB. Read-only: assign a whole matrix to change it.")
        .def_property("white_balance", tuple_getter(&P::white_balance), setter(&P::white_balance),
                      "(R, G, B): forward multipliers, > 0. Assign all three to change them.")
        .def_readwrite("gain", &P::gain,
                       "Forward multiplier, > 0; half of it makes the RAW-like image twice as bright.")
        .def_readwrite("brightness_sd_ev", &P::brightness_sd_ev,
                       "Standard deviation of the brightness's error in EV, 0 to 20; None: the model does not tell.")
        .def_readwrite("brightness_ev", &P::brightness_ev,
                       "By how much `gain` makes the result brighter than it was chosen, in EV; a record only.")
        .def_property("tone_weights", tuple_getter(&P::tone_weights), setter(&P::tone_weights),
                      "Four lists of weights, each of which sums to 1.")
        .def_property("gamma_weights", tuple_getter(&P::gamma_weights), setter(&P::gamma_weights), "A record.")
        .def_property("color_weights", tuple_getter(&P::color_weights), setter(&P::color_weights), "A record.")
        .def_property("white_balance_weights", tuple_getter(&P::white_balance_weights),
                      setter(&P::white_balance_weights), "A record.")
        .def_property("gain_weights", tuple_getter(&P::gain_weights), setter(&P::gain_weights), "A record.")
        .def_readwrite("model_name", &P::model_name, "Name of the model that they were chosen with.")
        .def_readwrite("model_hash", &P::model_hash, "Its hash; they can be applied with this model only.")
        .def_readwrite("reference_name", &P::reference_name, "Base name of the reference's file; may be empty.")
        .def_readwrite("reference_hash", &P::reference_hash, "Hash of its bytes; may be empty.")
        .def("to_json", &to_json, py::arg("indent") = 2,
             "As JSON text, which srisptool takes, too (params=); floats come back to the bit. indent < 0: one line.")
        .def_static(
            "from_json", &from_text, py::arg("text"), py::arg("where") = "JSON text",
            "From what to_json wrote, edited or not. `where` names the text in messages. Raises srisp.Error for "
            "unknown or missing keys, wrong types and lengths, values that are not finite or not > 0.")
        .def(
            "to_dict", [](const P& p) { return json_module().attr("loads")(to_json(p, -1)); },
            "As a dict of plain values, with the keys of the JSON.")
        .def_static(
            "from_dict",
            [](const py::dict& values) {
                return from_text(json_module().attr("dumps")(values).cast<std::string>(), "dict");
            },
            py::arg("values"), "From what to_dict gave. Raises as from_json does.")
        .def(
            "brightened",
            [](const P& p, double ev) {
                if (!(std::abs(ev) <= kLargestBrightnessEv))
                    throw py::value_error("ev is " + number(ev) + ": -20 to 20 is possible");
                P changed = p;
                require(choose_brightness(changed, { ev, false }, 0, ""));
                return changed;
            },
            py::arg("ev"), "A copy whose result is so many EV brighter (below 0: darker); -20 to 20.")
        .def(
            "check", [](const P& p, const Model& model) { require(check_parameters(p, model)); }, py::arg("model"),
            "Raises srisp.Error where they cannot be applied with this model.")
        .def(
            "__eq__", [](const P& a, const P& b) { return to_json(a, -1) == to_json(b, -1); }, py::is_operator())
        .def("__copy__", [](const P& p) { return P(p); })
        .def("__deepcopy__", [](const P& p, const py::dict&) { return P(p); })
        .def(py::pickle([](const P& p) { return py::make_tuple(to_json(p, -1)); },
                        [](const py::tuple& state) { return from_text(state[0].cast<std::string>(), "pickle"); }))
        .def("__repr__", &shown);
}

} // namespace srisp::python
