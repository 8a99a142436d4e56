// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>
#include <srisp/model.h>

#include "bindings.h"
#include "unlocked.h"

namespace srisp::python {

void bind_model(py::module_& module)
{
    // The library's models never change; pybind11 knows no pointers to what is const.
    const auto load = [](const std::string& name) {
        const Unlocked unlocked;
        return Model::load(name);
    };
    py::class_<Model, std::shared_ptr<Model>>(module, "Model", R"(A trained model, checked in full when it is loaded.

    Model("default")               by name; Model.available() lists them
    Model("runs/mine.safetensors") by path

It never changes, so any number of threads may use it. Raises srisp.Error for a file that is missing or malformed.)")
        .def(py::init([load](const py::object& name) {
                 return std::const_pointer_cast<Model>(value_of(load(path_of(name))));
             }),
             py::arg("name") = "default")
        .def_static("available", &Model::available,
                    "The names that can be loaded: of the folders in SRISP_MODEL_PATH, then those installed; sorted.")
        .def_property_readonly("name", &Model::name, "Base name of the file, without folder and extension.")
        .def_property_readonly(
            "path", [](const Model& model) { return path_text(model.path()); }, "The file that was read.")
        .def_property_readonly("hash", &Model::hash, "'xxh128:' and 32 hex digits, of the file's bytes.")
        .def_property_readonly("kernel_size", &Model::kernel_size, "Of the tone map: 3 (spatial) or 1 (pointwise).")
        .def_property_readonly("dictionary_size", &Model::dictionary_size, "Atoms per dictionary.")
        .def_property_readonly("metadata", &Model::metadata, "What the file says of itself: a dict of strings.")
        .def(py::pickle([](const Model& model) { return py::make_tuple(path_text(model.path()), model.hash()); },
                        [load](const py::tuple& state) {
                            auto model = value_of(load(path_of(state[0])));
                            if (model->hash() != state[1].cast<std::string>())
                                throw LibraryError("model '" + model->path() + "' has changed since it was pickled");
                            return std::const_pointer_cast<Model>(model);
                        }))
        .def(
            "__eq__", [](const Model& a, const Model& b) { return a.hash() == b.hash(); }, py::is_operator())
        .def("__hash__", [](const Model& model) { return py::hash(py::str(model.hash())); })
        .def("__repr__", [](const Model& model) {
            return "Model(" + shown_as(path_text(model.path())) +
                   ", kernel_size=" + std::to_string(model.kernel_size()) + ")";
        });
}

} // namespace srisp::python
