#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string_view>
#include <vector>

#include "condyle/io/provenance.hpp"
#include "condyle/joint.hpp"
#include "condyle/range_of_motion.hpp"
#include "joint.hpp"

namespace condyle::python {

namespace py = pybind11;

/// (name, vary, sense, start_deg, range_deg) of a motion, vary a position among the joint's angles, and back.
py::tuple tuple_of(const motion::Motion& motion);
motion::Motion motion_in(const py::tuple& given);
std::vector<motion::Motion> motions_in(const py::list& given);

/// Three angles in degrees.
JointAngles angles_in(const py::object& given, std::string_view name);

/// Points in `frame`: that of a joint held at a translation moves them back into its own.
py::dict dict_of(const motion::Limit& limit, const io::AnswerFrame& frame = {});
py::object dict_of(const std::optional<motion::ContactWitness>& contact, const io::AnswerFrame& frame = {});

}  // namespace condyle::python
