// SPDX-License-Identifier: Apache-2.0
#include "bindings.h"
#include "unlocked.h"

PYBIND11_MODULE(_core, module)
{
    using namespace srisp::python;
    module.doc() = "The compiled part of srisp. Use `import srisp`.";
    // The classes' module is what their signatures show and what pickle looks for: where users find them.
    const py::object own_name = module.attr("__name__");
    module.attr("__name__") = "srisp";
    module.attr("__version__") = SRISP_VERSION;
    py::register_exception<LibraryError>(module, "Error", PyExc_RuntimeError).doc() =
        "What srisp could not do; the message says what, where, the value and the limit.";
    watch_interpreter();
    bind_model(module);
    bind_parameters(module);
    bind_reference(module);
    bind_metadata(module);
    bind_images(module);
    bind_selection(module);
    bind_metrics(module);
    module.attr("__name__") = own_name;
}
