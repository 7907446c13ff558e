#pragma once

#include <pybind11/pybind11.h>

#include "condyle/radial.hpp"
#include "condyle/tangential.hpp"

namespace condyle::python {

namespace py = pybind11;

/// Contents of condyle.VertexGaps.
py::dict dict_of(RadialResults&& results);
py::dict dict_of(TangentialResults&& results);

}  // namespace condyle::python
