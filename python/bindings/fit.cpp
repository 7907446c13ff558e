#include "condyle/fit.hpp"
#include "kinematics/functional_centre.hpp"

#include <pybind11/stl.h>

#include <numeric>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/error.hpp"

namespace condyle::python {
namespace {

py::dict fit_dict(SphereFit fit) {
  py::dict dict;
  dict["centre"] = array_of(fit.sphere.centre);
  dict["radius"] = fit.sphere.radius;
  dict["rms_residual"] = fit.rms_residual;
  dict["largest_residual"] = fit.largest_residual;
  dict["vertices"] = array_of(std::move(fit.vertices));
  return dict;
}

py::dict fit_points(const py::object& given) {
  const PointsIn points(given, "points");
  return fit_dict(without_lock([&] { return fit_sphere(points.view()); }));
}

std::optional<Sphere> ball(const py::object& centre, double radius_mm) {
  if (centre.is_none()) return std::nullopt;
  return Sphere{vector_in(centre, "within"), radius_mm};
}

py::dict find_in(const Mesh& mesh, bool is_head, std::optional<double> smallest_radius,
                 std::optional<double> largest_radius, const py::object& within_centre, double within_radius,
                 std::size_t resamples) {
  const SphereSearch search{.part = is_head ? SphericalPart::head : SphericalPart::socket,
                            .smallest_radius = smallest_radius,
                            .largest_radius = largest_radius,
                            .within = ball(within_centre, within_radius),
                            .resamples = resamples};
  SphericalPatch patch = without_lock([&] { return find_sphere(mesh, search); });
  const double coverage = patch.coverage;
  py::dict dict = fit_dict(std::move(patch.fit));
  dict["coverage"] = coverage;
  dict["centre_bound"] = patch.centre_bound_mm;
  return dict;
}

py::dict fit_dict(CylinderFit&& fit) {
  py::dict dict;
  dict["point"] = array_of(fit.cylinder.point);
  dict["direction"] = array_of(fit.cylinder.direction);
  dict["radius"] = fit.cylinder.radius;
  dict["rms_residual"] = fit.rms_residual;
  dict["largest_residual"] = fit.largest_residual;
  dict["vertices"] = array_of(std::move(fit.vertices));
  dict["coverage"] = fit.coverage;
  dict["direction_bound_deg"] =
      fit.direction_bound ? py::object(py::float_(fit.direction_bound->degrees())) : py::none();
  dict["axis_bound"] = optional_number(fit.axis_bound_mm);
  return dict;
}

py::dict fit_cylinder_to(const py::object& given, const py::object& point, const py::object& direction,
                         double radius) {
  const PointsIn points(given, "points");
  const Vec3 along = vector_in(direction, "direction");
  if (along.norm() == 0) throw UsageError("direction: its length is zero");
  const Cylinder start{vector_in(point, "point"), along.normalized(), radius};
  return fit_dict([&] {
    const py::gil_scoped_release released;
    std::vector<Index> all(points.size());
    std::iota(all.begin(), all.end(), Index{0});
    return fit_cylinder(points.view(), all, start);
  }());
}

py::dict find_cylinder_in(const Mesh& mesh, double smallest_radius, double largest_radius,
                          const py::object& within_centre, double within_radius) {
  const CylinderSearch search{smallest_radius, largest_radius, ball(within_centre, within_radius)};
  return fit_dict(without_lock([&] { return find_cylinder(mesh, search); }));
}

/// `find` of the poses that are no gaps.
template <class Find>
auto found_of(const Find& find, const py::object& given) {
  std::vector<Pose> poses;
  for (const auto& pose : poses_with_gaps_in(given, "poses"))
    if (pose) poses.push_back(*pose);
  return without_lock([&] { return find(poses); });
}

template <class Found>
py::dict dict_of_turning(const Found& found) {
  py::dict dict;
  dict["about_axis_deg"] = found.turning.about_axis.degrees();
  dict["off_axis_deg"] = found.turning.off_axis.degrees();
  dict["residual_mm"] = found.residual_mm;
  dict["poses"] = found.poses;
  return dict;
}

py::dict functional_centre_of(const py::object& given) {
  const kinematics::FunctionalCentre found =
      found_of([](const std::vector<Pose>& poses) { return kinematics::functional_centre(poses); }, given);
  py::dict dict = dict_of_turning(found);
  dict["in_fixed"] = array_of(found.in_fixed);
  dict["in_mobile"] = array_of(found.in_mobile);
  dict["centre_bound_mm"] = found.centre_bound_mm;
  dict["sd_mm"] = found.sd_mm;
  return dict;
}

py::dict functional_axis_of(const py::object& given) {
  const kinematics::FunctionalAxis found =
      found_of([](const std::vector<Pose>& poses) { return kinematics::functional_axis(poses); }, given);
  py::dict dict = dict_of_turning(found);
  dict["point_in_fixed"] = array_of(found.in_fixed.point);
  dict["direction_in_fixed"] = array_of(found.in_fixed.direction);
  dict["point_in_mobile"] = array_of(found.in_mobile.point);
  dict["direction_in_mobile"] = array_of(found.in_mobile.direction);
  dict["direction_bound_deg"] = found.direction_bound.degrees();
  dict["axis_bound_mm"] = found.axis_bound_mm;
  return dict;
}

}  // namespace

void bind_fit(py::module_& module) {
  module.def("fit_sphere", &fit_points);
  module.def("find_sphere", &find_in);
  module.def("fit_cylinder", &fit_cylinder_to);
  module.def("find_cylinder", &find_cylinder_in);
  module.def("functional_centre", &functional_centre_of);
  module.def("functional_axis", &functional_axis_of);
}

}  // namespace condyle::python
