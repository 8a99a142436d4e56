// SPDX-License-Identifier: Apache-2.0
#include "bindings.h"

PYBIND11_MODULE(_core, module)
{
    using namespace srisp::python;
    module.doc() = "The compiled part of srisp. Use `import srisp`.";
    module.attr("__version__") = SRISP_VERSION;
    py::register_exception<LibraryError>(module, "Error", PyExc_RuntimeError).doc() =
        "What srisp could not do; the message says what, where, the value and the limit.";
    bind_model(module);
    bind_parameters(module);
    bind_reference(module);
    bind_metadata(module);
    bind_images(module);
    bind_selection(module);
    bind_metrics(module);
    // Where users find them, and pickle looks for them.
    for (const char* name : { "Error", "Model", "Parameters", "Reference", "CameraFacts", "NoiseModel", "Metadata" })
        module.attr(name).attr("__module__") = "srisp";
}
