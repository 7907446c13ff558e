#include "condyle/impingement_zone.hpp"

#include "arrays.hpp"
#include "bindings.hpp"

/// A clock face is two arrays, twelve and three.

namespace condyle::python {
namespace {

py::tuple clock_tuple(const motion::ClockFace& face) {
  return py::make_tuple(array_of(face.twelve), array_of(face.three));
}

py::object rim_clock(const Mesh& fixed, const py::object& centre, double radius_mm) {
  const Sphere head{vector_in(centre, "head_centre"), radius_mm};
  const std::optional<motion::ClockFace> face =
      without_lock([&] { return motion::find_rim_clock(fixed, head); });
  return face ? py::object(clock_tuple(*face)) : py::none();
}

py::object neck_axis(const Mesh& mobile, double head_radius_mm) {
  const std::optional<motion::NeckAxis> axis =
      without_lock([&] { return motion::find_neck_axis(mobile, head_radius_mm); });
  return axis ? py::object(array_of(axis->direction)) : py::none();
}

/// Degrees from 12 towards 3 of each direction.
py::array angles(const py::object& twelve, const py::object& three, const py::object& given) {
  const motion::ClockFace face{vector_in(twelve, "twelve"), vector_in(three, "three")};
  const PointsIn directions(given, "direction");
  std::vector<double> degrees(directions.size());
  for (std::size_t i = 0; i < degrees.size(); ++i) degrees[i] = face.angle_of(directions.view()[i]).degrees();
  return array_of(std::move(degrees));
}

py::array hours(const py::object& twelve, const py::object& three, const py::object& given) {
  const motion::ClockFace face{vector_in(twelve, "twelve"), vector_in(three, "three")};
  const PointsIn directions(given, "direction");
  std::vector<double> found(directions.size());
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = face.hour_of(directions.view()[i]);
  return array_of(std::move(found));
}

}  // namespace

void bind_clock_face(py::module_& module) {
  module.def("clock_face", [](const py::object& normal) {
    return clock_tuple(motion::clock_face(vector_in(normal, "normal")));
  });
  module.def("sagittal_clock", [] { return clock_tuple(motion::sagittal_clock()); });
  module.def("find_rim_clock", &rim_clock);
  module.def("find_neck_axis", &neck_axis);
  module.def("neck_clock", [](const py::object& direction) {
    return clock_tuple(motion::neck_clock({vector_in(direction, "direction")}));
  });
  module.def("clock_angles_deg", &angles);
  module.def("clock_hours", &hours);
}

}  // namespace condyle::python
