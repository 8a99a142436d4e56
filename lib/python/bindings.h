// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>
#include <srisp/expected.h>

// The module srisp._core: the public C++ headers, as plain as they are. What users call is Python, in srisp/.

namespace srisp::python {

namespace py = pybind11;

void bind_model(py::module_& module);
void bind_parameters(py::module_& module);
void bind_reference(py::module_& module);
void bind_metadata(py::module_& module);
void bind_images(py::module_& module);
void bind_selection(py::module_& module);
void bind_metrics(py::module_& module);

inline std::string text_of(py::handle object)
{
    return py::str(object).cast<std::string>();
}

/// As Python shows it: of a text with quotes.
inline std::string shown_as(py::handle object)
{
    return py::repr(object).cast<std::string>();
}
inline std::string quoted(const std::string& text)
{
    return shown_as(py::str(text));
}

/// Text that a file may have in any encoding; what is no UTF-8 becomes U+FFFD.
inline py::str any_text(const std::string& bytes)
{
    return py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(bytes.data(), py::ssize_t(bytes.size()), "replace"));
}

/// A path, from and to Python's own text of it. [os.fsencode]
inline py::str path_text(const std::string& path)
{
    return py::reinterpret_steal<py::str>(PyUnicode_DecodeFSDefaultAndSize(path.data(), py::ssize_t(path.size())));
}
inline std::string path_of(const py::object& path)
{
    return py::module_::import("os").attr("fsencode")(path).cast<std::string>();
}

/// Becomes srisp.Error.
struct LibraryError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A signal that came meanwhile (Ctrl-C, which also ends what the library runs for us) comes first.
[[noreturn]] inline void raise(const Error& error)
{
    if (PyErr_CheckSignals() != 0)
        throw py::error_already_set();
    throw LibraryError(any_text(error.message).cast<std::string>());
}

template<class T> T value_of(Expected<T> result)
{
    if (!result)
        raise(result.error());
    return std::move(*result);
}

inline void require(const Status& status)
{
    if (!status)
        raise(status.error());
}

} // namespace srisp::python
