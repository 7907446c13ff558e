#pragma once

#include <pybind11/pybind11.h>

/// The library's exceptions as Python's.

namespace condyle::python {

namespace py = pybind11;

void bind_errors(py::module_& module);

}  // namespace condyle::python
