#pragma once

#include <pybind11/pybind11.h>

#include "condyle/answer.hpp"
#include "condyle/io/joint_file.hpp"

namespace condyle::python {

namespace py = pybind11;

/// A plan as Python holds it, for a report: the joint with the bone, and the answer.
struct PlanHandle {
  io::LoadedJoint loaded;
  ResectionAnswer answer;
};

/// How bone is cut, of what cut_options() of Python has checked; without targets, marked vertices and range.
plan::ResectionOptions cut_in(const py::dict& given);

}  // namespace condyle::python
