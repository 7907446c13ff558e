#pragma once

#include <pybind11/pybind11.h>

#include "condyle/radial.hpp"
#include "condyle/tangential.hpp"

namespace condyle::python {

namespace py = pybind11;

/// Contents of condyle.VertexGaps.
py::dict dict_of(radial::RadialResults&& results);
py::dict dict_of(tangential::TangentialResults&& results);

}  // namespace condyle::python
