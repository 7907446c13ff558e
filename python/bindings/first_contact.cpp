#include "condyle/first_contact.hpp"

#include "arrays.hpp"
#include "bindings.hpp"
#include "motion.hpp"

namespace condyle::python {
namespace {

std::unique_ptr<motion::FirstContact> first_contact(const Mesh& fixed, const Mesh& mobile,
                                                    const py::object& point, const py::object& direction) {
  const AxisFrame axis(vector_in(point, "point"), vector_in(direction, "direction"));
  const py::gil_scoped_release released;
  return std::make_unique<motion::FirstContact>(fixed, mobile, axis);
}

/// Negative and positive.
py::tuple first_limits(const motion::FirstContact& contact, const py::object& pose, double negative_deg,
                       double positive_deg) {
  const Pose X_FM = one_pose(pose, "pose");
  const motion::RotationLimits found = without_lock([&] {
    return contact.limits(X_FM, {Angle::degrees(negative_deg), Angle::degrees(positive_deg)});
  });
  return py::make_tuple(dict_of(found.negative), dict_of(found.positive));
}

}  // namespace

void bind_first_contact(py::module_& module) {
  py::class_<motion::FirstContact>(module, "FirstContact")
      .def(py::init(&first_contact))
      .def("limits", &first_limits);
}

}  // namespace condyle::python
