#pragma once

#include <pybind11/pybind11.h>

#include "condyle/make_joint.hpp"

namespace condyle::python {

/// The description of a joint from the arguments of condyle.Joint, whose words were checked in Python. Lengths of the
/// dictionary are in mm.
JointDescription description_in(const pybind11::dict& given);

}  // namespace condyle::python
