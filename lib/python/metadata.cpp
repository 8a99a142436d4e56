// SPDX-License-Identifier: Apache-2.0
#include "metadata.h"

#include <pybind11/stl.h>
#include <srisp/metadata.h>
#include <srisp/mosaic.h>
#include <srisp/reference.h>

#include "bindings.h"
#include "loaded_reference.h"

namespace srisp::python {

namespace {

constexpr char kNoiseProfile[] = "unprocess:noise_profile";
constexpr char kNotes[] = "unprocess:notes";

template<class Value> py::object numbers(const OIIO::ParamValue& attribute)
{
    const auto* const values = static_cast<const Value*>(attribute.data());
    const std::size_t count = attribute.type().basevalues();
    if (count == 1)
        return py::cast(values[0]);
    return py::tuple(py::cast(std::vector<Value>(values, values + count)));
}

py::object value_of_attribute(const OIIO::ParamValue& attribute)
{
    switch (attribute.type().basetype) {
    case OIIO::TypeDesc::INT:
        return numbers<int>(attribute);
    case OIIO::TypeDesc::FLOAT:
        return numbers<float>(attribute);
    case OIIO::TypeDesc::DOUBLE:
        return numbers<double>(attribute);
    case OIIO::TypeDesc::UINT8:
        return py::bytes(static_cast<const char*>(attribute.data()), attribute.type().size());
    default:
        return any_text(attribute.get_string());
    }
}

py::dict items(const Metadata& metadata)
{
    py::dict values;
    for (const OIIO::ParamValue& attribute : metadata.spec.extra_attribs)
        values[any_text(attribute.name().string())] = value_of_attribute(attribute);
    return values;
}

void set(Metadata& metadata, const std::string& name, const py::object& value)
{
    OIIO::ImageSpec& spec = metadata.spec;
    if (value.is_none())
        spec.erase_attribute(name, OIIO::TypeDesc::UNKNOWN, true);
    else if (py::isinstance<py::str>(value))
        spec.attribute(name, value.cast<std::string>());
    else if (py::isinstance<py::int_>(value))
        spec.attribute(name, value.cast<int>());
    else if (py::isinstance<py::float_>(value))
        spec.attribute(name, value.cast<float>());
    else if (py::isinstance<py::bytes>(value)) {
        const std::string bytes = value.cast<std::string>();
        spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(bytes.size())), bytes.data());
    } else {
        const auto floats = value.cast<std::vector<float>>();
        spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, int(floats.size())), floats.data());
    }
}

/// Names, types and bytes; of texts the texts.
py::tuple state_of(const Metadata& metadata)
{
    py::list attributes;
    for (const OIIO::ParamValue& attribute : metadata.spec.extra_attribs) {
        const bool text = attribute.type().basetype == OIIO::TypeDesc::STRING;
        const py::object value =
            text ? py::object(py::bytes(attribute.get_string()))
                 : py::object(py::bytes(static_cast<const char*>(attribute.data()), attribute.datasize()));
        attributes.append(py::make_tuple(attribute.name().string(), std::string(attribute.type().c_str()), value));
    }
    const OIIO::ImageSpec& spec = metadata.spec;
    return py::make_tuple(attributes, spec.channelnames, spec.alpha_channel, spec.z_channel);
}

Metadata from_state(const py::tuple& state)
{
    Metadata metadata;
    OIIO::ImageSpec& spec = metadata.spec;
    for (const py::handle item : state[0].cast<py::list>()) {
        const auto attribute = item.cast<py::tuple>();
        const OIIO::TypeDesc type(attribute[1].cast<std::string>());
        const auto name = attribute[0].cast<std::string>(), bytes = attribute[2].cast<std::string>();
        if (type.basetype == OIIO::TypeDesc::STRING)
            spec.attribute(name, bytes);
        else if (type.size() == bytes.size())
            spec.attribute(name, type, bytes.data());
    }
    spec.channelnames = state[1].cast<std::vector<std::string>>();
    spec.nchannels = int(spec.channelnames.size());
    spec.alpha_channel = state[2].cast<int>();
    spec.z_channel = state[3].cast<int>();
    return metadata;
}

/// Of a mosaic.
Metadata with_cfa_pattern(const Metadata& before, const std::string& pattern)
{
    if (!pattern.empty())
        static_cast<void>(value_of(parse_bayer_phase(pattern)));
    Metadata metadata = before;
    metadata.spec.nchannels = 1;
    metadata.spec.channelnames = { "Y" };
    record_cfa_pattern(metadata.spec, pattern);
    return metadata;
}

/// As `record_result` says it, with what is known of filters and noise kept.
Metadata recorded(const Metadata& before, const std::optional<Parameters>& parameters, const LoadedReference* reference)
{
    const auto known = parameters ? *parameters : recorded_parameters(before.spec, "image");
    const CameraFacts* const camera = reference ? &reference->get().facts : nullptr;
    Metadata metadata = before;
    record_result(metadata.spec, known ? *known : Parameters(), camera, Direction::reverse);
    if (const OIIO::ParamValue* const noise = before.spec.find_attribute(kNoiseProfile))
        metadata.spec.attribute(kNoiseProfile, noise->type(), noise->data());
    if (const std::string pattern = recorded_cfa_pattern(before.spec); !pattern.empty())
        record_cfa_pattern(metadata.spec, pattern);
    return metadata;
}

} // namespace

void bind_metadata(py::module_& module)
{
    py::class_<Metadata>(module, "Metadata",
                         R"(What an image says of itself: parameters, camera, notes, and what its file said.

dict(metadata.items()) shows all of it; OpenImageIO's names are used.)")
        .def(py::init<>())
        .def(
            "set_channels",
            [](Metadata& m, const std::vector<std::string>& names, int alpha) {
                m.spec.channelnames = names;
                m.spec.alpha_channel = alpha;
            },
            py::arg("names"), py::arg("alpha") = -1)
        .def("items", [](const Metadata& m) { return items(m).attr("items")(); })
        .def("__getitem__",
             [](const Metadata& m, const std::string& name) {
                 const OIIO::ParamValue* const found = m.spec.find_attribute(name);
                 if (!found)
                     throw py::key_error(name);
                 return value_of_attribute(*found);
             })
        .def(
            "get",
            [](const Metadata& m, const std::string& name, const py::object& fallback) {
                const OIIO::ParamValue* const found = m.spec.find_attribute(name);
                return found ? value_of_attribute(*found) : fallback;
            },
            py::arg("name"), py::arg("default") = py::none())
        .def("__setitem__", &set, "Text, int, float, bytes, or a sequence of floats; None removes it.")
        .def("__contains__",
             [](const Metadata& m, const std::string& name) { return m.spec.find_attribute(name) != nullptr; })
        .def("__len__", [](const Metadata& m) { return m.spec.extra_attribs.size(); })
        .def("copy", [](const Metadata& m) { return Metadata(m); })
        .def_property_readonly("cfa_pattern", [](const Metadata& m) { return recorded_cfa_pattern(m.spec); })
        .def("with_cfa_pattern", &with_cfa_pattern, py::arg("pattern"),
             "A copy that is of a mosaic with these filters.")
        .def("recorded", &recorded, py::arg("parameters") = py::none(), py::arg("reference") = py::none(),
             "A copy that says so of parameters and reference camera, as unprocess() does.")
        .def_property_readonly("parameters",
                               [](const Metadata& m) -> std::optional<Parameters> {
                                   const auto found = recorded_parameters(m.spec, "image");
                                   return found ? std::optional(*found) : std::nullopt;
                               })
        .def_property_readonly("notes", [](const Metadata& m) { return any_text(m.spec.get_string_attribute(kNotes)); })
        .def(py::pickle(&state_of, &from_state))
        .def("__repr__", [](const Metadata& m) {
            return "<srisp.Metadata of " + std::to_string(m.spec.extra_attribs.size()) + " attributes>";
        });
}

} // namespace srisp::python
