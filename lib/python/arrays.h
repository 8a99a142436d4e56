// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include <pybind11/numpy.h>
#include <srisp/image.h>
#include <srisp/image_input.h>

#include "bindings.h"
#include "metadata.h"

namespace srisp::python {

/// An array H × W or H × W × C of any strides, as an image that refers to its memory: the array must outlive it.
/// `metadata` is what it says of itself. uint8, uint16, float16, float32 or float64, else TypeError; ValueError for
/// other shapes and for empty ones.
MemoryImage image_of(const py::array& array, const Metadata& metadata, const std::string& name);

/// The bytes of a path, or an array as above.
ImageInput input_of(const py::object& image, const Metadata& metadata, const std::string& name);

/// 0: all; ValueError below.
int checked_threads(int threads);

/// A 3 × 3 matrix of Python's, row-major.
std::array<float, 9> row_major(const std::array<std::array<float, 3>, 3>& rows);

/// The R, G, B of an array H × W × 3 of float32 whose channels are adjacent; `what` names it in errors.
ImageView view_of(const py::array& array, const char* what);
MutableImageView mutable_view_of(py::array& array, const char* what);

} // namespace srisp::python
